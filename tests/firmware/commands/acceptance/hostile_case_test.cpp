// SPDX-License-Identifier: MIT
// Random and hostile CASE folders: a number where there should be another, a torn file, lines lost
// or doubled. None may crash the program or keep it for ever, and no result may hold a NaN.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>

#include "tests/firmware/commands/acceptance/flight_folder.h"
#include "tests/firmware/commands/acceptance/made_case.h"

namespace plumbline::acceptance {
namespace {

class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  void spoil(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    const int wounds = 1 + pick(3);
    for (int i = 0; i < wounds; ++i) {
      const fs::path& file = files[static_cast<std::size_t>(pick(static_cast<int>(files.size())))];
      std::string text = text_of(file);
      if (!text.empty()) wound(text);
      write_text(file, text);
    }
  }

 private:
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  std::size_t place(const std::string& text) {
    return static_cast<std::size_t>(pick(static_cast<int>(text.size())));
  }

  void wound(std::string& text) {
    switch (pick(6)) {
      case 0:
        return replace_number(text);
      case 1:
        text.resize(place(text));
        return;
      case 2:
        text[place(text)] = static_cast<char>(pick(256));
        return;
      case 3:
        return repeat_line(text);
      case 4:
        return lose_line(text);
      default:
        return scale_column(text);
    }
  }

  void replace_number(std::string& text) {
    static constexpr std::array kNumbers = {"0",        "-1",     "nan",  "inf", "-inf",
                                            "1e308",    "1e-308", "1e99", "",    "-0.0",
                                            "99999999", "1e-12",  "0x10", "1,5"};
    const std::size_t first = text.find_first_of("0123456789", place(text));
    if (first == std::string::npos) return;
    const std::size_t last = text.find_first_not_of("0123456789.-+e", first);
    text.replace(first, last == std::string::npos ? last : last - first,
                 kNumbers[static_cast<std::size_t>(pick(static_cast<int>(kNumbers.size())))]);
  }

  std::pair<std::size_t, std::size_t> line(const std::string& text) {
    const std::size_t begin = text.rfind('\n', place(text));
    const std::size_t first = begin == std::string::npos ? 0 : begin + 1;
    const std::size_t end = text.find('\n', first);
    return {first, end == std::string::npos ? text.size() : end + 1};
  }
  void repeat_line(std::string& text) {
    const auto [first, last] = line(text);
    text.insert(first, text.substr(first, last - first));
  }
  void lose_line(std::string& text) {
    const auto [first, last] = line(text);
    text.erase(first, last - first);
  }

  // Every number with a point becomes a thousand times as large: a wrong unit.
  void scale_column(std::string& text) {
    for (std::size_t at = text.find('.'); at != std::string::npos; at = text.find('.', at + 4)) {
      text.insert(std::min(at + 4, text.size()), "e3");
    }
  }

  std::mt19937 random_;
};

bool is_none(const std::string& cell) {
  return cell == "nan" || cell == "-nan" || cell == "inf" || cell == "-inf";
}

class HostileCase : public FolderTest {};

TEST_F(HostileCase, NeitherCrashesNorHangsNorGivesNumbersThatAreNone) {
  const char* const wanted = std::getenv("PLUMBLINE_HOSTILE_CASES");
  const unsigned cases = wanted != nullptr ? static_cast<unsigned>(std::atoi(wanted)) : 60;
  int refused = 0;
  for (unsigned seed = 1; seed <= cases; ++seed) {
    SCOPED_TRACE(seed);
    fs::remove_all(folder / "case");
    write_case({.seed = 70, .control = seed % 2 == 0, .length = seed % 3 == 0}, folder / "case");
    Damage(seed).spoil(folder / "case");
    const Outcome outcome =
        run_any({"timeout", "300", PLUMBLINE_PROGRAM, "orient", "case"}, folder);
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 1) << outcome.status << outcome.err;
    if (outcome.status != 0) {
      ++refused;
      EXPECT_FALSE(outcome.err.empty());
      EXPECT_FALSE(fs::exists(folder / "case/result"));
      continue;
    }
    for (const char* file : {"points.csv", "photos.csv", "observations.csv"}) {
      for (const auto& row : rows_of(folder / "case/result" / file)) {
        for (const auto& [column, cell] : row) EXPECT_FALSE(is_none(cell)) << file << ' ' << column;
      }
    }
    const std::string summary = text_of(folder / "case/result/summary.json");
    EXPECT_EQ(summary.find("nan"), std::string::npos);
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace plumbline::acceptance
