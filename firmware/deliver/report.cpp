// SPDX-License-Identifier: MIT
#include "firmware/deliver/report.h"

#include "firmware/deliver/figures.h"
#include "firmware/deliver/html.h"
#include "firmware/deliver/report_sections.h"
#include "firmware/deliver/report_style.h"
#include "firmware/deliver/report_tables.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"
#include "firmware/deliver/verdict.h"

namespace plumbline::deliver {
namespace {

std::string heading(const std::string& words) { return element("h2", escaped(words)) + "\n"; }

std::string section(const std::string& title, const std::string& content) {
  return content.empty() ? "" : heading(title) + content;
}

// Numbers the figures as they come.
class Figures {
 public:
  std::string add(const Figure& figure) {
    if (figure.svg.empty()) return {};
    const std::string words =
        element("b", "Figure " + std::to_string(++count_) + ".") + " " + escaped(figure.caption);
    return element("figure", figure.svg + element("figcaption", words)) + "\n";
  }

 private:
  int count_ = 0;
};

// Worth a figure of its own where the frame of the whole is much weaker than the shape.
bool shape_is_much_better(const Product& product) {
  const PointKinds kinds = point_kinds(product);
  const auto& points = kinds.named.empty() ? kinds.ties : kinds.named;
  const auto all = sigma_figures(product, points);
  const auto local = local_sigma_figures(product, points);
  return all && local && all->median.head<2>().norm() > 2.0 * local->median.head<2>().norm();
}

std::string figures(const Product& product) {
  Figures numbered;
  std::string all = numbered.add(plan_figure(product, EllipseKind::kAbsolute));
  if (shape_is_much_better(product)) all += numbered.add(plan_figure(product, EllipseKind::kLocal));
  all += numbered.add(section_figure(product));
  all += numbered.add(check_figure(product));
  return all + numbered.add(residual_figure(product));
}

std::string check_section(const Product& product) {
  if (!product.check) return {};
  return list_of(check_sentences(*product.check)) + check_table(*product.check);
}

std::string body(const Product& product) {
  return report_header(product) + verdict_box(product) + key_figures(product) +
         section("What is not observable, and what to do about it", unobservable_section(product)) +
         section("How far these figures may be relied upon",
                 element("div", reliance_table(product), "reliance")) +
         section("Warnings", list_of(all_warnings(product))) +
         section("Where the points are, and how well they are known", figures(product)) +
         section("Check points", check_section(product)) +
         section("Accuracy by distance", ring_table(product)) +
         section("Points", named_point_table(product) + map_coordinate_table(product)) +
         section("Photos", station_table(product) + attitude_table(product)) +
         section("Camera", camera_table(product)) +
         section("Adjustment", adjustment_section(product)) +
         section("How to read this report", glossary()) +
         section("Files measured", element("div", input_table(product), "inputs")) +
         report_footer();
}

}  // namespace

std::string report_html(const Product& product) {
  const std::string head =
      "<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width\"/>\n" +
      element("title", escaped(product.title) + " \xe2\x80\x93 measurement") + "\n<style>" +
      kReportStyle + "</style>\n";
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n" + head + "</head>\n<body>\n" +
         body(product) + "</body>\n</html>\n";
}

}  // namespace plumbline::deliver
