// SPDX-License-Identifier: MIT
#include "firmware/deliver/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/firmware/deliver/sample_product.h"

namespace plumbline::deliver {
namespace {

using testing::HasSubstr;
using testing::Not;

// Whether every element is closed in its order and every & begins an entity of XML; the first
// fault in words, or nothing.
std::string fault_of_markup(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = text.find("<html"); at < text.size(); ++at) {
    if (text[at] == '&' && text.find(';', at) > at + 6) return "bare & at " + text.substr(at, 30);
    if (text[at] != '<') continue;
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos) return "open tag at " + text.substr(at, 30);
    const std::string tag = text.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
    if (tag[0] == '/') {
      if (open.empty() || "/" + open.back() != tag) return "<" + tag + "> closes nothing";
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end;
  }
  return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

std::vector<SampleOptions> kinds_of_result() {
  std::vector<SampleOptions> kinds(7);
  kinds[1].side_step = false;
  kinds[2].poor_gnss = true;
  kinds[2].check = false;
  kinds[3].ties = 0;
  kinds[3].georeferenced = false;
  kinds[4].one_unoriented = true;
  kinds[5].named = 0;
  kinds[6].named = kinds[6].ties = 0;
  kinds[6].georeferenced = false;
  return kinds;
}

TEST(Report, IsWellFormedForEveryKindOfResult) {
  for (const SampleOptions& options : kinds_of_result())
    EXPECT_EQ(fault_of_markup(report_html(sample_product(options))), "");
}

TEST(Report, FetchesNothingAndRunsNothing) {
  for (const SampleOptions& options : kinds_of_result()) {
    const std::string page = report_html(sample_product(options));
    for (const char* word : {"http", "src=", "href=", "@import", "<script", "url(//", "data:"})
      EXPECT_THAT(page, Not(HasSubstr(word)));
  }
}

TEST(Report, NamesCannotBreakThePage) {
  Product product = sample_product();
  product.title = "A & B <b>";
  product.problem.point_names[0] = "<script>alert(1)</script>";
  product.problem.point_names[1] = "\" onload=\"x";
  product.problem.photos[0].name = "a<b&c>.jpg";
  product.check->points[0].point = "</table>";
  product.solution.summary.warnings.push_back("a \xff b < c");
  const std::string page = report_html(product);
  EXPECT_EQ(fault_of_markup(page), "");
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_THAT(page, HasSubstr("a&lt;b&amp;c&gt;.jpg"));
}

TEST(Report, SaysWhatIsNotObservableAndWhatToDoBeforeAnyFigure) {
  SampleOptions options;
  options.side_step = false;
  const std::string page = report_html(sample_product(options));
  ASSERT_THAT(page, HasSubstr("Fly 10 m aside at the top"));
  EXPECT_LT(page.find("Fly 10 m aside at the top"), page.find("<figure"));
}

TEST(Report, AShapeMuchBetterThanItsFrameHasAFigureOfItsOwn) {
  SampleOptions options;
  EXPECT_THAT(report_html(sample_product(options)), Not(HasSubstr("ellipses of the shape alone")));
  options.side_step = false;
  EXPECT_THAT(report_html(sample_product(options)), HasSubstr("ellipses of the shape alone"));
}

TEST(Report, SaysThatWithoutCheckPointsNothingIsVerified) {
  SampleOptions options;
  options.check = false;
  EXPECT_THAT(report_html(sample_product(options)), HasSubstr("predicted, not verified"));
  EXPECT_THAT(report_html(sample_product()), HasSubstr("verified at independent check points"));
}

TEST(Report, ErrorsLargerThanStatedAreNotCalledGood) {
  Product product = sample_product();
  product.check->joint_nees = 2.0 * product.check->joint_nees_high;
  const std::string page = report_html(product);
  EXPECT_THAT(page, HasSubstr("verdict bad"));
  EXPECT_THAT(page, HasSubstr("LARGER than the stated covariance allows"));
}

TEST(Report, StaysBelowAMegabyteWithThousandsOfTies) {
  SampleOptions options;
  options.ties = 6000;
  EXPECT_LT(report_html(sample_product(options)).size(), 1000000u);
}

TEST(Report, PhotosNotOrientedAreListedAsSuch) {
  SampleOptions options;
  options.one_unoriented = true;
  EXPECT_THAT(report_html(sample_product(options)), HasSubstr("not oriented"));
}

// The checker itself must be able to fail.
TEST(MarkupChecker, FindsWhatIsBroken) {
  EXPECT_NE(fault_of_markup("<html><p></html>"), "");
  EXPECT_NE(fault_of_markup("<html>a & b</html>"), "");
  EXPECT_EQ(fault_of_markup("<html><br/>a &amp; b</html>"), "");
}

}  // namespace
}  // namespace plumbline::deliver
