// SPDX-License-Identifier: MIT
#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

#include "sim/profile.h"

// Reads a profile file: profile_example.toml documents the keys.

namespace plumbline::sim {
namespace {

// Puts a value into the profile; the sentence of what is wanted instead where it does not fit.
using Put = std::function<std::optional<std::string>(Profile&, const toml::node&)>;

std::string plain(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string wanted(double low, double high) {
  return "a number from " + plain(low) + " to " + plain(high);
}

std::optional<double> number_in(const toml::node& node, double low, double high) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value >= low && *value <= high)) return std::nullopt;
  return value;
}

template <typename Field>
Put number(Field field, double low, double high) {
  return [=](Profile& profile, const toml::node& node) -> std::optional<std::string> {
    const auto value = number_in(node, low, high);
    if (!value) return wanted(low, high);
    field(profile) = *value;
    return std::nullopt;
  };
}

template <typename Field>
Put whole_number(Field field, int low, int high) {
  return [=](Profile& profile, const toml::node& node) -> std::optional<std::string> {
    const auto value = number_in(node, low, high);
    if (!value || *value != std::floor(*value)) {
      return "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    }
    field(profile) = static_cast<int>(*value);
    return std::nullopt;
  };
}

template <typename Field>
Put yes_or_no(Field field) {
  return [=](Profile& profile, const toml::node& node) -> std::optional<std::string> {
    if (!node.is_boolean()) return "true or false";
    field(profile) = *node.value<bool>();
    return std::nullopt;
  };
}

// An array of exactly `count` numbers.
std::optional<std::vector<double>> numbers_in(const toml::node& node, std::size_t count, double low,
                                              double high) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != count) return std::nullopt;
  std::vector<double> values;
  for (const toml::node& entry : *array) {
    const auto value = number_in(entry, low, high);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

template <typename Field>
Put numbers(Field field, std::size_t count, double low, double high) {
  return [=](Profile& profile, const toml::node& node) -> std::optional<std::string> {
    const auto values = numbers_in(node, count, low, high);
    if (!values)
      return "a list of " + std::to_string(count) + " numbers from " + plain(low) + " to " +
             plain(high);
    for (std::size_t k = 0; k < count; ++k) field(profile)[k] = (*values)[k];
    return std::nullopt;
  };
}

template <typename Field>
Put sigma_pair(Field field) {
  return [=](Profile& profile, const toml::node& node) -> std::optional<std::string> {
    const auto values = numbers_in(node, 2, 0, 1000);
    if (!values) return "[horizontal, vertical], two numbers from 0 to 1000";
    field(profile) = SigmaPair{(*values)[0], (*values)[1]};
    return std::nullopt;
  };
}

std::optional<std::string> put_side_steps(Profile& profile, const toml::node& node) {
  const toml::array* array = node.as_array();
  const auto single = number_in(node, 0, 500);
  const auto several = array ? numbers_in(node, array->size(), 0, 500) : std::nullopt;
  if (!single && !several) return "a number from 0 to 500, or a list of them";
  profile.side_steps_m = several ? *several : std::vector<double>{*single};
  std::erase(profile.side_steps_m, 0.0);
  return std::nullopt;
}

std::optional<std::string> put_fix(Profile& profile, const toml::node& node) {
  const auto fix = fix_of(node.value_or(std::string()));
  if (!fix) return "\"fixed\", \"float\" or \"single\"";
  set_fix(profile, *fix);
  return std::nullopt;
}

std::optional<std::string> put_base(Profile& profile, const toml::node& node) {
  const auto base = named_profile(node.value_or(std::string()));
  if (!base) return "\"paper\", \"standard\" or \"ice\"";
  profile = *base;
  return std::nullopt;
}

#define PLUMBLINE_FIELD(member) ([](Profile & p) -> auto& { return p.member; })

std::map<std::string, Put> flight_keys() {
  return {
      {"from_m", number(PLUMBLINE_FIELD(from_m), 5, 1000)},
      {"to_m", number(PLUMBLINE_FIELD(to_m), 5, 1000)},
      {"step_m", number(PLUMBLINE_FIELD(step_m), 0.1, 1000)},
      {"side_step_m", put_side_steps},
      {"side_direction_deg", number(PLUMBLINE_FIELD(side_direction_deg), -360, 360)},
      {"drift_m", number(PLUMBLINE_FIELD(drift_m), 0, 100)},
      {"wander_m", number(PLUMBLINE_FIELD(wander_m), 0, 20)},
      {"height_sigma_m", number(PLUMBLINE_FIELD(height_sigma_m), 0, 5)},
      {"tilt_sigma_deg", number(PLUMBLINE_FIELD(tilt_sigma_deg), 0, 10)},
      {"yaw_deg", number(PLUMBLINE_FIELD(yaw_deg), -360, 360)},
      {"yaw_sigma_deg", number(PLUMBLINE_FIELD(yaw_sigma_deg), 0, 180)},
      {"climb_rate_m_s", number(PLUMBLINE_FIELD(climb_rate_m_s), 0.1, 30)},
      {"pause_s", number(PLUMBLINE_FIELD(pause_s), 0, 600)},
      {"gnss", yes_or_no(PLUMBLINE_FIELD(gnss))},
      {"gnss_white_sigma_m", sigma_pair(PLUMBLINE_FIELD(gnss_error.white))},
      {"gnss_offset_sigma_m", sigma_pair(PLUMBLINE_FIELD(gnss_error.offset))},
      {"gnss_correlated_sigma_m", sigma_pair(PLUMBLINE_FIELD(gnss_error.correlated))},
      {"gnss_correlation_s", number(PLUMBLINE_FIELD(gnss_error.correlation_s), 0.01, 1e6)},
      {"heading", yes_or_no(PLUMBLINE_FIELD(heading))},
      {"heading_sigma_deg", number(PLUMBLINE_FIELD(heading_sigma_deg), 0, 180)},
  };
}

std::map<std::string, Put> picture_keys() {
  return {
      {"width_px", whole_number(PLUMBLINE_FIELD(width_px), 64, 20000)},
      {"height_px", whole_number(PLUMBLINE_FIELD(height_px), 64, 20000)},
      {"focal_length_px", number(PLUMBLINE_FIELD(focal_length_px), 50, 100000)},
      {"pixel_pitch_um", number(PLUMBLINE_FIELD(pixel_pitch_um), 0.3, 50)},
      {"principal_offset_px", numbers(PLUMBLINE_FIELD(principal_offset_px), 2, -500, 500)},
      {"radial", numbers(PLUMBLINE_FIELD(radial), 3, -1, 1)},
      {"tangential", numbers(PLUMBLINE_FIELD(tangential), 2, -0.1, 0.1)},
      {"focal_sigma_px", number(PLUMBLINE_FIELD(focal_sigma_px), 0, 1000)},
      {"principal_sigma_px", number(PLUMBLINE_FIELD(principal_sigma_px), 0, 200)},
      {"radial_sigma", number(PLUMBLINE_FIELD(radial_sigma), 0, 0.1)},
      {"tangential_sigma", number(PLUMBLINE_FIELD(tangential_sigma), 0, 0.01)},
      {"blur_px", number(PLUMBLINE_FIELD(blur_px), 0, 10)},
      {"motion_blur_px", number(PLUMBLINE_FIELD(motion_blur_px), 0, 50)},
      {"noise", number(PLUMBLINE_FIELD(noise), 0, 20)},
      {"vignetting", number(PLUMBLINE_FIELD(vignetting), 0, 0.9)},
      {"jpeg_quality", whole_number(PLUMBLINE_FIELD(jpeg_quality), 50, 100)},
      {"targets", whole_number(PLUMBLINE_FIELD(targets), 0, 500)},
      {"target_diameter_m", number(PLUMBLINE_FIELD(target_diameter_m), 0.02, 5)},
      {"pick_sigma_px", number(PLUMBLINE_FIELD(pick_sigma_px), 0, 10)},
      {"relief", number(PLUMBLINE_FIELD(relief), 0, 3)},
      {"texture_pixel_m", number(PLUMBLINE_FIELD(texture_pixel_m), 0.001, 1)},
      {"origin_latitude_deg", number(PLUMBLINE_FIELD(origin_latitude_deg), -89, 89)},
      {"origin_longitude_deg", number(PLUMBLINE_FIELD(origin_longitude_deg), -180, 180)},
      {"origin_height_m", number(PLUMBLINE_FIELD(origin_height_m), -400, 8000)},
  };
}

#undef PLUMBLINE_FIELD

std::string at(const std::string& name, const toml::source_region& where) {
  return name + ":" + std::to_string(where.begin.line) + ": ";
}

Status put(Profile& profile, const std::string& key, const Put& into, const toml::node& node,
           const std::string& name) {
  const auto instead = into(profile, node);
  if (!instead) return Done{};
  return Error{at(name, node.source()) + key + " wants " + *instead + "."};
}

Result<Profile> from_table(const toml::table& table, const std::string& name) {
  Profile profile;
  // What other keys then change comes first.
  for (const auto& [key, into] :
       {std::pair<std::string, Put>{"base", put_base}, {"fix", put_fix}}) {
    const toml::node* node = table.get(key);
    if (node == nullptr) continue;
    if (Status done = put(profile, key, into, *node, name); !done) return done.error();
  }
  std::map<std::string, Put> keys = flight_keys();
  keys.merge(picture_keys());
  for (const auto& [key, node] : table) {
    const std::string word(key.str());
    if (word == "base" || word == "fix") continue;
    const auto found = keys.find(word);
    if (found == keys.end()) {
      return Error{at(name, key.source()) + "'" + word +
                   "' is no key of a simulated flight; sim/profile_example.toml lists them all."};
    }
    if (Status done = put(profile, word, found->second, node, name); !done) return done.error();
  }
  profile.name = name;
  return profile;
}

}  // namespace

Result<Profile> parse_profile(const std::string& text, const std::string& name) {
  try {
    Result<Profile> profile = from_table(toml::parse(text, name), name);
    if (!profile) return profile;
    if (Status fit = check(*profile); !fit) return Error{name + ": " + fit.error().sentence};
    return profile;
  } catch (const toml::parse_error& error) {
    return Error{at(name, error.source()) + std::string(error.description()) + "."};
  }
}

}  // namespace plumbline::sim
