// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "edge/base/units.h"
#include "edge/geodesy/plane_rectangular.h"

namespace plumbline::geodesy {
namespace {

// Zones follow prefectures (and parts of Hokkaido, Tokyo, Kagoshima and Okinawa). The nearest of
// these towns says in which one a place lies, to some ten kilometres on the borders.
struct Town {
  double latitude_deg;
  double longitude_deg;
  int zone;
};
constexpr std::array kTowns = {
    // I: Nagasaki, and Kagoshima's islands from 27 to 32 north, 128d18' to 130 east
    Town{32.75, 129.87, 1}, Town{33.18, 129.72, 1}, Town{32.70, 128.84, 1}, Town{33.75, 129.69, 1},
    Town{34.20, 129.29, 1}, Town{34.65, 129.47, 1}, Town{28.38, 129.49, 1}, Town{27.40, 128.65, 1},
    Town{29.85, 129.87, 1},
    // II: the rest of Kyushu
    Town{33.59, 130.40, 2}, Town{33.88, 130.88, 2}, Town{33.25, 130.30, 2}, Town{33.27, 129.88, 2},
    Town{33.45, 129.97, 2}, Town{32.79, 130.74, 2}, Town{32.46, 130.19, 2}, Town{33.24, 131.61, 2},
    Town{33.60, 131.19, 2}, Town{31.91, 131.42, 2}, Town{32.58, 131.66, 2}, Town{31.60, 130.56, 2},
    Town{32.02, 130.19, 2}, Town{31.25, 130.65, 2}, Town{30.73, 131.00, 2}, Town{30.39, 130.66, 2},
    // III: Yamaguchi, Shimane, Hiroshima
    Town{34.19, 131.47, 3}, Town{33.96, 130.94, 3}, Town{34.41, 131.40, 3}, Town{34.17, 132.22, 3},
    Town{35.47, 133.05, 3}, Town{34.90, 132.08, 3}, Town{34.68, 131.85, 3}, Town{36.20, 133.30, 3},
    Town{34.40, 132.46, 3}, Town{34.81, 132.85, 3}, Town{34.49, 133.36, 3},
    // IV: Shikoku
    Town{34.34, 134.05, 4}, Town{34.19, 133.81, 4}, Town{33.84, 132.77, 4}, Town{34.07, 133.00, 4},
    Town{33.22, 132.56, 4}, Town{34.07, 134.56, 4}, Town{33.73, 134.53, 4}, Town{33.56, 133.53, 4},
    Town{32.99, 132.93, 4}, Town{33.29, 134.16, 4},
    // V: Hyogo, Tottori, Okayama
    Town{34.69, 135.20, 5}, Town{34.82, 134.69, 5}, Town{35.54, 134.82, 5}, Town{34.35, 134.90, 5},
    Town{35.50, 134.24, 5}, Town{35.43, 133.33, 5}, Town{34.66, 133.93, 5}, Town{35.07, 134.00, 5},
    Town{34.98, 133.46, 5}, Town{35.14, 135.05, 5},
    // VI: Kyoto, Osaka, Fukui, Shiga, Mie, Nara, Wakayama
    Town{35.02, 135.76, 6}, Town{35.47, 135.39, 6}, Town{35.70, 135.03, 6}, Town{34.69, 135.52, 6},
    Town{34.41, 135.30, 6}, Town{36.07, 136.22, 6}, Town{35.65, 136.06, 6}, Town{35.00, 135.87, 6},
    Town{35.38, 136.27, 6}, Town{34.73, 136.51, 6}, Town{35.00, 136.62, 6}, Town{34.07, 136.19, 6},
    Town{34.49, 136.71, 6}, Town{34.69, 135.83, 6}, Town{34.00, 135.80, 6}, Town{34.23, 135.17, 6},
    Town{33.73, 135.38, 6}, Town{33.48, 135.79, 6}, Town{35.30, 135.13, 6},
    // VII: Ishikawa, Toyama, Gifu, Aichi
    Town{36.59, 136.63, 7}, Town{37.39, 136.90, 7}, Town{37.44, 137.26, 7}, Town{36.70, 137.21, 7},
    Town{36.82, 137.40, 7}, Town{35.39, 136.72, 7}, Town{36.14, 137.25, 7}, Town{35.49, 137.50, 7},
    Town{35.75, 136.94, 7}, Town{35.18, 136.91, 7}, Town{34.77, 137.39, 7}, Town{35.08, 137.16, 7},
    // VIII: Niigata, Nagano, Yamanashi, Shizuoka
    Town{37.90, 139.02, 8}, Town{38.22, 139.48, 8}, Town{37.11, 138.24, 8}, Town{37.45, 138.85, 8},
    Town{38.02, 138.37, 8}, Town{36.93, 138.81, 8}, Town{37.04, 137.86, 8}, Town{36.65, 138.19, 8},
    Town{36.23, 137.97, 8}, Town{35.51, 137.82, 8}, Town{36.35, 138.63, 8}, Town{35.66, 138.57, 8},
    Town{35.49, 138.80, 8}, Town{34.98, 138.38, 8}, Town{34.71, 137.73, 8}, Town{35.10, 138.86, 8},
    Town{34.68, 138.95, 8}, Town{35.10, 139.07, 8},
    // IX: Kanto, Fukushima, the Izu islands
    Town{35.69, 139.69, 9}, Town{35.66, 139.32, 9}, Town{35.81, 139.10, 9}, Town{34.75, 139.36, 9},
    Town{34.08, 139.53, 9}, Town{33.11, 139.79, 9}, Town{37.75, 140.47, 9}, Town{37.49, 139.93, 9},
    Town{37.40, 140.38, 9}, Town{37.05, 140.89, 9}, Town{37.80, 140.92, 9}, Town{37.20, 139.77, 9},
    Town{36.57, 139.88, 9}, Town{36.98, 140.05, 9}, Town{36.37, 140.47, 9}, Town{36.08, 140.20, 9},
    Town{36.80, 140.75, 9}, Town{35.86, 139.65, 9}, Town{36.02, 139.08, 9}, Town{35.60, 140.12, 9},
    Town{35.73, 140.83, 9}, Town{35.00, 139.86, 9}, Town{36.39, 139.06, 9}, Town{36.65, 139.04, 9},
    Town{36.62, 138.60, 9}, Town{35.45, 139.64, 9}, Town{35.26, 139.15, 9}, Town{35.14, 139.62, 9},
    // X: Tohoku without Fukushima
    Town{40.82, 140.74, 10}, Town{40.51, 141.49, 10}, Town{41.29, 141.18, 10},
    Town{40.60, 140.47, 10}, Town{39.72, 140.10, 10}, Town{39.31, 140.57, 10},
    Town{40.20, 140.02, 10}, Town{38.24, 140.36, 10}, Town{38.91, 139.84, 10},
    Town{37.92, 140.11, 10}, Town{39.70, 141.15, 10}, Town{39.08, 141.71, 10},
    Town{39.64, 141.96, 10}, Town{40.19, 141.78, 10}, Town{38.27, 140.87, 10},
    Town{38.43, 141.30, 10}, Town{38.91, 141.57, 10}, Town{38.06, 139.99, 10},
    // XI: south-western Hokkaido (Otaru, Hakodate, Date, Shiribeshi, Oshima, Hiyama)
    Town{43.19, 140.99, 11}, Town{41.77, 140.73, 11}, Town{42.47, 140.87, 11},
    Town{42.90, 140.76, 11}, Town{41.87, 140.13, 11}, Town{42.07, 139.45, 11},
    Town{42.44, 139.85, 11}, Town{41.43, 140.11, 11}, Town{43.33, 140.35, 11},
    // XII: middle Hokkaido
    Town{43.06, 141.35, 12}, Town{42.32, 140.97, 12}, Town{42.63, 141.60, 12},
    Town{43.77, 142.37, 12}, Town{45.42, 141.67, 12}, Town{43.94, 141.64, 12},
    Town{43.20, 141.78, 12}, Town{42.17, 142.77, 12}, Town{43.34, 142.38, 12},
    Town{44.36, 142.46, 12}, Town{45.24, 141.22, 12}, Town{44.36, 143.35, 12},
    Town{44.93, 142.58, 12}, Town{42.93, 142.40, 12}, Town{44.06, 143.53, 12},
    // XIII: eastern Hokkaido
    Town{42.92, 143.20, 13}, Town{42.98, 144.38, 13}, Town{43.33, 145.58, 13},
    Town{43.80, 143.89, 13}, Town{44.02, 144.27, 13}, Town{44.02, 145.19, 13},
    Town{42.29, 143.32, 13}, Town{43.24, 143.55, 13}, Town{43.55, 144.97, 13},
    Town{44.03, 145.86, 13}, Town{45.23, 147.88, 13}, Town{43.86, 146.82, 13},
    Town{43.12, 142.88, 13},
    // The islands of the south
    Town{27.09, 142.19, 14}, Town{26.64, 142.16, 14}, Town{24.78, 141.32, 14},
    Town{26.21, 127.68, 15}, Town{26.59, 127.98, 15}, Town{26.34, 126.80, 15},
    Town{27.04, 127.97, 15}, Town{24.81, 125.28, 16}, Town{24.34, 124.16, 16},
    Town{24.47, 123.00, 16}, Town{25.75, 123.47, 16}, Town{25.83, 131.23, 17},
    Town{24.47, 131.19, 17}, Town{20.42, 136.08, 18}, Town{24.29, 153.98, 19}};

constexpr double kReachKm = 150;
constexpr double kKmPerDegree = 111.2;

// Korea, Taiwan and Sakhalin lie within reach of Japanese towns.
bool is_a_neighbour(double latitude_deg, double longitude_deg) {
  return longitude_deg < 122.7 || latitude_deg > 45.65 ||
         (latitude_deg > 34.8 && longitude_deg < 130.2);
}

}  // namespace

int plane_rectangular_zone_of(double latitude_deg, double longitude_deg) {
  if (is_a_neighbour(latitude_deg, longitude_deg)) return 0;
  double nearest_km = kReachKm;
  int zone = 0;
  for (const Town& town : kTowns) {
    const double north_km = kKmPerDegree * (latitude_deg - town.latitude_deg);
    const double east_km =
        kKmPerDegree * (longitude_deg - town.longitude_deg) * std::cos(latitude_deg * kRadPerDeg);
    const double distance_km = std::hypot(north_km, east_km);
    if (!(distance_km < nearest_km)) continue;
    nearest_km = distance_km;
    zone = town.zone;
  }
  return zone;
}

}  // namespace plumbline::geodesy
