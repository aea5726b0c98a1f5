// SPDX-License-Identifier: MIT
#include "firmware/ingest/photo_files.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>
#include <system_error>

#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view take_digits(std::string_view& text) {
  std::size_t length = 0;
  while (length < text.size() && is_digit(text[length])) ++length;
  std::string_view digits = text.substr(0, length);
  text.remove_prefix(length);
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

bool is_jpeg_name(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".jpg" || ending == ".jpeg" || ending == ".jpe";
}

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

class Finder {
 public:
  Status add(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) {
      return Error{"There is no file or folder " + in_quotes(path.string()) + "."};
    }
    if (fs::is_directory(status)) return add_folder(path);
    if (is_jpeg_name(path)) {
      found_.files.push_back({path, path.filename().string()});
    } else {
      others_.push_back(path.filename().string());
    }
    return Done{};
  }

  Result<PhotoFiles> finish(const std::vector<fs::path>& paths) {
    warn_of_others();
    if (found_.files.empty()) {
      return Error{"There are no JPEG photos in " + names_of(paths) +
                   "; photos end in .jpg or .jpeg."};
    }
    make_names_unique();
    std::ranges::sort(found_.files, [](const PhotoFile& a, const PhotoFile& b) {
      return a.name != b.name ? natural_less(a.name, b.name) : a.path < b.path;
    });
    return std::move(found_);
  }

 private:
  // A flight keeps its photos in photos/ and its camera beside them.
  Status add_folder(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder / "photos", error)) return add_files_of(folder);
    if (fs::exists(folder / "camera.toml", error)) found_.camera_toml = folder / "camera.toml";
    return add_files_of(folder / "photos");
  }

  Status add_files_of(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      std::error_code ignored;
      if (is_hidden(at->path()) || at->is_directory(ignored)) continue;
      if (const Status added = add(at->path()); !added) return added;
    }
    if (!error) return Done{};
    return Error{"Cannot read the folder " + in_quotes(folder.string()) + ": " + error.message() +
                 "."};
  }

  void warn_of_others() {
    if (others_.empty()) return;
    std::ranges::sort(others_);
    constexpr std::size_t kNamed = 3;
    std::string sentence = std::to_string(others_.size()) +
                           (others_.size() == 1 ? " file that is" : " files that are") +
                           " not JPEG by name left out: ";
    for (std::size_t i = 0; i < std::min(kNamed, others_.size()); ++i) {
      sentence += (i > 0 ? ", " : "") + in_quotes(others_[i]);
    }
    found_.warnings.push_back(sentence + (others_.size() > kNamed ? ", ..." : "."));
  }

  void make_names_unique() {
    std::map<std::string, int> count;
    for (const PhotoFile& file : found_.files) ++count[file.name];
    for (PhotoFile& file : found_.files) {
      if (count[file.name] == 1) continue;
      file.name = (file.path.parent_path().filename() / file.name).string();
    }
  }

  static std::string names_of(const std::vector<fs::path>& paths) {
    std::string names;
    for (const fs::path& path : paths) {
      names += (names.empty() ? "" : ", ") + in_quotes(path.string());
    }
    return names.empty() ? "what was given" : names;
  }

  PhotoFiles found_;
  std::vector<std::string> others_;
};

}  // namespace

bool natural_less(const std::string& a, const std::string& b) {
  std::string_view left = a;
  std::string_view right = b;
  while (!left.empty() && !right.empty()) {
    if (is_digit(left.front()) && is_digit(right.front())) {
      const std::string_view x = take_digits(left);
      const std::string_view y = take_digits(right);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      continue;
    }
    if (left.front() != right.front()) return left.front() < right.front();
    left.remove_prefix(1);
    right.remove_prefix(1);
  }
  if (left.empty() != right.empty()) return left.empty();
  return a < b;  // 007 and 7 are still two names
}

Result<PhotoFiles> find_photo_files(const std::vector<fs::path>& paths) {
  Finder finder;
  for (const fs::path& path : paths) {
    if (const Status added = finder.add(path); !added) return added.error();
  }
  return finder.finish(paths);
}

}  // namespace plumbline::ingest
