// SPDX-License-Identifier: MIT
#include "firmware/service/measuring/result_figures.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::service {
namespace {

constexpr const char* kSummary = R"({
  "photos_used": 15,
  "unobservable": ["scale"],
  "point_sigmas": {"of": "tie points", "median_e_m": 0.0163, "median_n_m": 0.0184,
                   "median_u_m": 0.0127}
})";

TEST(ResultFigures, AreThoseOfTheSummaryInTwoLengths) {
  const ingest::TemporaryFolder folder;
  folder.write("summary.json", std::string(kSummary));
  const auto figures = read_result(folder.path());
  ASSERT_TRUE(figures);
  EXPECT_EQ(in_words(*figures), "Median sigma 1.6/1.8/1.3 cm east/north/up.");
  EXPECT_EQ(for_the_pilot(*figures), "Result 15 photos: 1.6/1.8/1.3 cm");
}

TEST(ResultFigures, SayWhatIsUnknownAndFitAPilotsLine) {
  const ResultFigures figures{128, {12.34, 2.5, 0.2}, true};
  EXPECT_EQ(in_words(figures), "Median sigma 12.3/2.5/0.2 m east/north/up, azimuth unknown.");
  EXPECT_EQ(for_the_pilot(figures), "Result 128 photos: 12.3/2.5/0.2 m, no azimuth");
  EXPECT_LE(for_the_pilot(figures).size(), 50u);
}

TEST(ResultFigures, AreNoneWhereTheSummaryIsMissingCutOrHasNoNumber) {
  const ingest::TemporaryFolder folder;
  EXPECT_FALSE(read_result(folder.path()));
  const std::string whole = kSummary;
  folder.write("summary.json", whole.substr(0, whole.size() / 2));
  EXPECT_FALSE(read_result(folder.path()));
  folder.write("summary.json", std::string(R"({"photos_used": 3, "unobservable": [],
    "point_sigmas": {"median_e_m": null, "median_n_m": 1, "median_u_m": 1}})"));
  EXPECT_FALSE(read_result(folder.path()));
  folder.write("summary.json", std::string("[]"));
  EXPECT_FALSE(read_result(folder.path()));
}

}  // namespace
}  // namespace plumbline::service
