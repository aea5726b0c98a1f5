// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/image.h"
#include "edge/base/progress.h"
#include "edge/base/result.h"
#include "firmware/ingest/photo_record.h"

namespace plumbline::ingest {

struct PhotoSet {
  std::vector<PhotoRecord> photos;  // two or more, of one size, sorted by name (numbers by value)
  int photos_given = 0;             // JPEG files found, the dropped ones too
  std::optional<std::filesystem::path> camera_toml;  // beside the photos of a flight
  std::vector<std::string> warnings;                 // sentences: what was left out, and why
};

// Takes in photos: any mixture of JPEG files, folders of them, and flight folders (with photos/).
// Every photo is read and decoded once in full, so that one that is cut short, or is no JPEG at
// all, is left out here with a warning. Left out too: files of other kinds and exact copies; hidden
// files without a word. Fails with one sentence on a path that is missing or unreadable, where
// fewer than two good photos remain, and where sizes differ (naming those of the rarer size).
Result<PhotoSet> read_photos(const std::vector<std::filesystem::path>& paths, int threads,
                             const Progress& progress);

// The photo's pixels. Fails where the file has changed since it was taken in or cannot be read.
// Reentrant.
Result<Image> load_grey(const PhotoRecord& photo);
Result<Image> load_rgb(const PhotoRecord& photo);

}  // namespace plumbline::ingest
