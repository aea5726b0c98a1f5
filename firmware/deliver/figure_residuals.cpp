// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "firmware/deliver/chart.h"
#include "firmware/deliver/figures.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

constexpr std::size_t kMostPanels = 12;
constexpr std::size_t kMostArrows = 700;  // in a panel
constexpr int kColumns = 3;
constexpr double kPanelWidth = 306;
constexpr double kGap = 16;
constexpr double kTitle = 22;
constexpr double kLongestArrow = 45;

// The residuals of one photo.
struct Panel {
  int photo = 0;
  std::vector<std::size_t> used;
  std::vector<std::size_t> rejected;
};

std::vector<Panel> all_panels(const Product& product) {
  std::vector<Panel> all(product.problem.photos.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i].photo = static_cast<int>(i);
  for (std::size_t k = 0; k < product.problem.observations.size(); ++k) {
    const orient::Observation& observation = product.problem.observations[k];
    const orient::ObservationResidual& residual = product.solution.residuals[k];
    if (!product.solution.photos[static_cast<std::size_t>(observation.photo)].oriented ||
        !product.solution.points[static_cast<std::size_t>(observation.point)].measured ||
        !residual.residual_px.allFinite())
      continue;
    Panel& panel = all[static_cast<std::size_t>(observation.photo)];
    (residual.used ? panel.used : panel.rejected).push_back(k);
  }
  std::erase_if(all, [](const Panel& panel) { return panel.used.empty(); });
  return all;
}

template <typename T>
std::vector<T> evenly(const std::vector<T>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * (all.size() - 1) / (most - 1)]);
  return some;
}

class Residuals {
 public:
  explicit Residuals(const Product& product)
      : product_(product),
        all_(all_panels(product)),
        panels_(evenly(all_, kMostPanels)),
        shrink_(kPanelWidth / product.solution.camera.width_px) {
    std::vector<double> lengths_px;
    for (const Panel& panel : panels_)
      for (const std::size_t k : panel.used) lengths_px.push_back(residual(k).norm());
    factor_ = exaggeration(lengths_px, shrink_, 8, 1e9);
  }

  Figure draw() const {
    const std::size_t rows = (panels_.size() + kColumns - 1) / kColumns;
    const double height = static_cast<double>(rows) * (kTitle + panel_height() + kGap) + 40;
    Svg svg(kColumns * kPanelWidth + (kColumns - 1) * kGap, height,
            "Residuals of the image coordinates, photo by photo");
    for (std::size_t i = 0; i < panels_.size(); ++i) draw_panel(svg, i);
    draw_scale(svg, height - 20);
    return {svg.finish(), caption()};
  }

 private:
  double panel_height() const { return shrink_ * product_.solution.camera.height_px; }
  const Eigen::Vector2d& residual(std::size_t k) const {
    return product_.solution.residuals[k].residual_px;
  }

  std::vector<Svg::Arrow> arrows(const std::vector<std::size_t>& observations,
                                 const Place& corner) const {
    std::vector<Svg::Arrow> made;
    for (const std::size_t k : evenly(observations, kMostArrows)) {
      const Place from =
          corner + shrink_ * (product_.problem.observations[k].pixel + Place(0.5, 0.5));
      Place along = factor_ * shrink_ * residual(k);
      if (along.norm() > kLongestArrow) along *= kLongestArrow / along.norm();
      made.push_back({from, from + along});
    }
    return made;
  }

  double rms_px(const Panel& panel) const {
    double sum = 0;
    for (const std::size_t k : panel.used) sum += residual(k).squaredNorm();
    return std::sqrt(sum / (2.0 * static_cast<double>(panel.used.size())));
  }

  void draw_panel(Svg& svg, std::size_t i) const {
    const Panel& panel = panels_[i];
    const auto column = static_cast<double>(i % kColumns);
    const std::size_t row_above = i / kColumns;
    const auto row = static_cast<double>(row_above);
    const Place title(column * (kPanelWidth + kGap),
                      row * (kTitle + panel_height() + kGap) + kTitle - 7);
    const Place corner = title + Place(0, 7);
    svg.text(title, product_.problem.photos[static_cast<std::size_t>(panel.photo)].name, "label");
    svg.text(title + Place(kPanelWidth, 0),
             std::to_string(panel.used.size()) + " used, RMS " + fixed(rms_px(panel), 2) + " px",
             "tick end");
    svg.rectangle(corner, {kPanelWidth, panel_height()}, "ground framed");
    svg.begin_clip("photo-" + std::to_string(i), corner, {kPanelWidth, panel_height()});
    svg.arrows(arrows(panel.used, corner), "arrows");
    svg.arrows(arrows(panel.rejected, corner), "arrows rejected");
    svg.end_clip();
  }

  void draw_scale(Svg& svg, double y) const {
    const double length_px = nice_below(70.0 / (factor_ * shrink_));
    const double units = length_px * factor_ * shrink_;
    svg.arrows({{{2, y}, {2 + units, y}}}, "arrows");
    svg.text({units + 12, y + 4}, "residual of " + significant(length_px, 1) + " px", "tick");
    svg.arrows({{{kPanelWidth + kGap, y}, {kPanelWidth + kGap + 30, y}}}, "arrows rejected");
    svg.text({kPanelWidth + kGap + 38, y + 4}, "rejected, not used (long ones cut short)", "tick");
  }

  std::string caption() const {
    std::string words = "Residuals of the image coordinates (measured minus computed), " +
                        exaggeration_words(factor_) + " against the image. ";
    words += all_.size() > panels_.size() ? std::to_string(panels_.size()) + " of " +
                                                std::to_string(all_.size()) + " photos are shown. "
                                          : "";
    return words +
           "Arrows that point in all directions are noise; a pattern would be a flaw of "
           "the camera model.";
  }

  const Product& product_;
  std::vector<Panel> all_;
  std::vector<Panel> panels_;
  double shrink_;
  double factor_ = 1;
};

}  // namespace

Figure residual_figure(const Product& product) {
  if (product.solution.camera.width_px <= 0 || all_panels(product).empty()) return {};
  return Residuals(product).draw();
}

}  // namespace plumbline::deliver
