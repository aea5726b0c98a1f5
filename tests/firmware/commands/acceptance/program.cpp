// SPDX-License-Identifier: MIT
#include "tests/firmware/commands/acceptance/program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace plumbline::acceptance {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

void send_to_file(int fd, const fs::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || ::dup2(file, fd) < 0) ::_exit(126);
}

[[noreturn]] void become(const std::vector<std::string>& command, const fs::path& folder,
                         const fs::path& out, const fs::path& err) {
  send_to_file(STDOUT_FILENO, out);
  send_to_file(STDERR_FILENO, err);
  if (::chdir(folder.c_str()) != 0) ::_exit(126);
  std::vector<char*> argv;
  for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

int wait_for(pid_t child) {
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Outcome run_any(const std::vector<std::string>& command, const fs::path& folder) {
  std::string name = (fs::temp_directory_path() / "plumbline-run-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) return {};
  const fs::path streams = name;
  const pid_t child = ::fork();
  if (child == 0) become(command, folder, streams / "out", streams / "err");
  Outcome outcome;
  outcome.status = wait_for(child);
  outcome.out = text_of(streams / "out");
  outcome.err = text_of(streams / "err");
  fs::remove_all(streams);
  return outcome;
}

Outcome run_plumbline(std::vector<std::string> arguments, const fs::path& folder) {
  arguments.insert(arguments.begin(), PLUMBLINE_PROGRAM);
  return run_any(arguments, folder);
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[fs::relative(entry.path(), folder).string()] = text_of(entry.path());
    }
  }
  return files;
}

std::vector<std::map<std::string, std::string>> rows_of(const fs::path& csv) {
  std::ifstream file(csv);
  std::vector<std::string> header;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto cells = cells_of(line);
    if (header.empty()) {
      header = cells;
      continue;
    }
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < header.size() && i < cells.size(); ++i) row[header[i]] = cells[i];
  }
  return rows;
}

Json summary_of(const fs::path& result) {
  return Json::parse(text_of(result / "summary.json"), nullptr, false);
}

std::string lines_of(const Json& list) {
  std::string lines;
  for (const auto& item : list) lines += item.get<std::string>() + "\n";
  return lines;
}

std::string digits(double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.10g", value);
  return buffer;
}

}  // namespace plumbline::acceptance
