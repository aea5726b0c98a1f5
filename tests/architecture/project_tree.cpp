// SPDX-License-Identifier: MIT
#include "tests/architecture/project_tree.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string_view>

#include "tests/architecture/style_rules.h"

namespace plumbline::architecture {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string_view> kSourceFolders = {"edge", "drivers", "sim", "firmware",
                                                      "tests"};
const std::vector<std::string_view> kOtherFolders = {"cmake",   "scripts", ".ci",
                                                     "systemd", "docs",    "packages"};

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool is_text(const fs::path& path) {
  static const std::vector<std::string_view> kinds = {".cpp",  ".h",    ".txt", ".cmake",  ".md",
                                                      ".toml", ".json", ".sh",  ".service"};
  const std::string extension = path.extension().string();
  return extension.empty() || std::find(kinds.begin(), kinds.end(), extension) != kinds.end();
}

void add_tree(const fs::path& root, std::string_view folder, std::vector<SourceFile>& files) {
  if (!fs::is_directory(root / folder)) return;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
    if (!entry.is_regular_file() || !is_text(entry.path())) continue;
    files.push_back(
        {entry.path().lexically_relative(root).generic_string(), text_of(entry.path())});
  }
}

void sort_by_path(std::vector<SourceFile>& files) {
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
}

std::optional<std::string> output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  if (!pipe) return std::nullopt;
  std::string output;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
    output += static_cast<char>(c);
  }
  return output;
}

}  // namespace

std::vector<SourceFile> source_files(const fs::path& root) {
  std::vector<SourceFile> files;
  for (const std::string_view folder : kSourceFolders) add_tree(root, folder, files);
  std::erase_if(files, [](const SourceFile& file) { return !is_cpp(file.path); });
  sort_by_path(files);
  return files;
}

std::vector<SourceFile> text_files(const fs::path& root) {
  std::vector<SourceFile> files;
  for (const std::string_view folder : kSourceFolders) add_tree(root, folder, files);
  for (const std::string_view folder : kOtherFolders) add_tree(root, folder, files);
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    if (!entry.is_regular_file() || !is_text(entry.path())) continue;
    files.push_back({entry.path().filename().string(), text_of(entry.path())});
  }
  sort_by_path(files);
  return files;
}

std::optional<std::vector<FileSize>> versioned_files(const fs::path& root) {
  if (!fs::exists(root / ".git")) return std::nullopt;
  const auto listing = output_of("git -C '" + root.string() + "' ls-files -z");
  if (!listing || listing->empty()) return std::nullopt;
  std::vector<FileSize> files;
  std::istringstream paths(*listing);
  for (std::string path; std::getline(paths, path, '\0');) {
    std::error_code unreadable;
    const std::uintmax_t bytes = fs::file_size(root / path, unreadable);
    if (!unreadable) files.push_back({path, bytes});
  }
  return files;
}

}  // namespace plumbline::architecture
