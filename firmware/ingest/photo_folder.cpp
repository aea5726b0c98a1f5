// SPDX-License-Identifier: MIT
#include "firmware/ingest/photo_folder.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "edge/base/parallel.h"
#include "edge/jpeg/jpeg.h"
#include "firmware/ingest/file_hash.h"
#include "firmware/ingest/photo_files.h"
#include "firmware/ingest/photo_tags.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxPhotoBytes = std::size_t{512} << 20;

// What became of one file.
struct Intake {
  PhotoRecord record;
  std::vector<std::string> warnings;
  std::optional<Error> unreadable;  // the file: fails the whole
  std::optional<Error> damaged;     // the photo in it: it is left out
};

Intake take_in(const PhotoFile& file) {
  Intake intake;
  intake.record.name = file.name;
  intake.record.path = file.path;
  const auto bytes = read_bytes(file.path, kMaxPhotoBytes);
  if (!bytes) {
    intake.unreadable = bytes.error();
    return intake;
  }
  const Result<Image> image = jpeg::decode_grey(*bytes, file.name);
  if (!image) {
    intake.damaged = image.error();
    return intake;
  }
  intake.record.bytes = bytes->size();
  intake.record.sha256 = sha256_hex(*bytes);
  intake.record.width_px = image->width_px;
  intake.record.height_px = image->height_px;
  interpret(read_tags(*bytes, file.name, intake.warnings), intake.record, intake.warnings);
  return intake;
}

std::vector<Intake> take_in_all(const std::vector<PhotoFile>& files, int threads,
                                const Progress& progress) {
  std::vector<Intake> intakes(files.size());
  const int count = static_cast<int>(files.size());
  std::mutex lock;
  int done = 0;
  parallel_for(count, threads, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    intakes[at] = take_in(files[at]);
    const std::lock_guard<std::mutex> guard(lock);
    ++done;
    if (progress) progress("reading photos", done, count);
  });
  return intakes;
}

// "'a.jpg', 'b.jpg' and 3 more"
std::string photos_named(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(kNamed, names.size()); ++i) {
    list += (i > 0 ? ", " : "") + in_quotes(names[i]);
  }
  if (names.size() > kNamed) list += " and " + std::to_string(names.size() - kNamed) + " more";
  return list;
}

Status check_sizes(const std::vector<PhotoRecord>& photos) {
  std::map<std::pair<int, int>, std::vector<std::string>> by_size;
  for (const PhotoRecord& photo : photos) {
    by_size[{photo.width_px, photo.height_px}].push_back(photo.name);
  }
  if (by_size.size() <= 1) return Done{};
  const auto fewer = [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); };
  const auto rarest = std::ranges::min_element(by_size, fewer);
  const auto usual = std::ranges::max_element(by_size, fewer);
  const auto text = [](const std::pair<int, int>& size) {
    return std::to_string(size.first) + " x " + std::to_string(size.second);
  };
  // As many of one as of the other: then the second is named.
  const auto odd = rarest == usual ? std::prev(by_size.end()) : rarest;
  return Error{"The photos differ in size: " + photos_named(odd->second) +
               (odd->second.size() == 1 ? " has " : " have ") + text(odd->first) +
               " pixels, others " + text(rarest == usual ? by_size.begin()->first : usual->first) +
               "; measure photos of one camera and one setting at a time."};
}

class Gathering {
 public:
  Status add(Intake intake) {
    ++set_.photos_given;
    if (intake.unreadable) return *intake.unreadable;
    for (std::string& warning : intake.warnings) set_.warnings.push_back(std::move(warning));
    if (intake.damaged) {
      if (!first_damage_) first_damage_ = intake.damaged;
      set_.warnings.push_back("Left out: " + intake.damaged->sentence);
      return Done{};
    }
    const auto [same, added] = by_hash_.emplace(intake.record.sha256, intake.record.name);
    if (added) {
      set_.photos.push_back(std::move(intake.record));
    } else {
      copies_.push_back(in_quotes(intake.record.name) + " is an exact copy of " +
                        in_quotes(same->second));
      set_.warnings.push_back("Photo " + copies_.back() + " and was left out.");
    }
    return Done{};
  }

  Result<PhotoSet> finish(PhotoFiles files) {
    set_.camera_toml = std::move(files.camera_toml);
    set_.warnings.insert(set_.warnings.begin(), files.warnings.begin(), files.warnings.end());
    if (set_.photos.size() < 2) return too_few();
    if (const Status sizes = check_sizes(set_.photos); !sizes) return sizes.error();
    return std::move(set_);
  }

 private:
  Error too_few() const {
    std::string sentence = set_.photos.empty() ? "There is no usable photo"
                                               : "There is only one usable photo, " +
                                                     in_quotes(set_.photos.front().name);
    sentence += "; two or more of the same ground are needed.";
    if (first_damage_) sentence += " " + first_damage_->sentence;
    if (!copies_.empty()) sentence += " Photo " + copies_.front() + ".";
    return {sentence};
  }

  PhotoSet set_;
  std::map<std::string, std::string> by_hash_;
  std::optional<Error> first_damage_;
  std::vector<std::string> copies_;
};

template <typename Decode>
Result<Image> load(const PhotoRecord& photo, const Decode& decode) {
  const auto bytes = read_bytes(photo.path, kMaxPhotoBytes);
  if (!bytes) return bytes.error();
  Result<Image> image = decode(*bytes, photo.name);
  if (!image) return image;
  if (bytes->size() != photo.bytes || image->width_px != photo.width_px ||
      image->height_px != photo.height_px) {
    return Error{"Photo " + in_quotes(photo.name) +
                 " has changed since it was first read; start again."};
  }
  return image;
}

}  // namespace

Result<PhotoSet> read_photos(const std::vector<fs::path>& paths, int threads,
                             const Progress& progress) {
  Result<PhotoFiles> files = find_photo_files(paths);
  if (!files) return files.error();
  Gathering gathering;
  for (Intake& intake : take_in_all(files->files, threads, progress)) {
    if (const Status added = gathering.add(std::move(intake)); !added) return added.error();
  }
  return gathering.finish(*std::move(files));
}

Result<Image> load_grey(const PhotoRecord& photo) { return load(photo, jpeg::decode_grey); }
Result<Image> load_rgb(const PhotoRecord& photo) { return load(photo, jpeg::decode_rgb); }

}  // namespace plumbline::ingest
