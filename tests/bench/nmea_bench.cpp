// SPDX-License-Identifier: MIT
// The decoder of a receiver's bytes beside a plain scan of the same bytes for line ends (memchr).
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "edge/gnss/stream_decoder.h"

namespace plumbline {
namespace {

std::string sentence(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char ending[8];
  std::snprintf(ending, sizeof ending, "*%02X\r\n", sum);
  return "$" + body + ending;
}

// Ten minutes of what Reach sends with everything switched on: GGA five times a second, the rest
// once.
std::string made_log() {
  std::string log;
  for (int epoch = 0; epoch < 3000; ++epoch) {
    char time[16];
    std::snprintf(time, sizeof time, "10%02d%02d.%02d", epoch / 300, epoch / 5 % 60,
                  epoch % 5 * 20);
    const std::string t = time;
    const std::string place = ",3540.1234567,N,13945.7654321,E,";
    log += sentence("GNGGA," + t + place + "4,17,1.0,52.140,M,38.123,M,1.2,0001");
    if (epoch % 5 != 0) continue;
    log += sentence("GNRMC," + t + ",A" + place + "0.31,271.54,201126,,,D,V");
    log += sentence("GNGST," + t + ",11.000,0.012,0.011,84.8,0.011,0.012,0.025");
    log += sentence("GNVTG,271.54,T,,M,0.31,N,0.57,K,D");
    log += sentence("GNZDA," + t + ",20,11,2026,00,00");
    log += sentence("GPGSA,A,3,05,07,13,15,20,28,30,,,,,,1.8,1.0,1.5");
    for (int i = 0; i < 3; ++i) {
      log += sentence("GPGSV,3,1,12,05,06,110,19,07,44,210,33,13,61,320,44,15,22,080,38");
    }
    log += sentence("GNEBP,3540.1234567,N,13945.7654321,E,90.2630,M");
  }
  return log;
}

std::string made_llh() {
  std::string log = "%  GPST latitude\n";
  for (int epoch = 0; epoch < 3000; ++epoch) {
    char time[16];
    std::snprintf(time, sizeof time, "10:%02d:%02d.%d00", epoch / 300, epoch / 5 % 60,
                  epoch % 5 * 2);
    log +=
        std::string("2026/11/20 ") + time +
        "   35.668724278  139.762757202    90.2630   1  17   0.0110   0.0120   0.0250  -0.0050   "
        "0.0060  -0.0070   1.20    9.9\n";
  }
  return log;
}

void decode(benchmark::State& state, const std::string& log) {
  std::size_t fixes = 0;
  for (auto _ : state) {
    const auto decoder = gnss::make_fix_decoder([&](const GnssFix&, ByteRange) { ++fixes; });
    constexpr std::size_t kRead = 4096;
    for (std::size_t at = 0; at < log.size(); at += kRead) {
      decoder->feed(std::string_view(log).substr(at, kRead));
    }
    decoder->cut();
  }
  benchmark::DoNotOptimize(fixes);
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * log.size()));
}

void scan(benchmark::State& state, const std::string& log) {
  for (auto _ : state) {
    std::size_t lines = 0;
    const char* end = log.data() + log.size();
    for (const char* at = log.data(); at < end; ++at, ++lines) {
      const auto left = static_cast<std::size_t>(end - at);
      at = static_cast<const char*>(std::memchr(at, '\n', left));
      if (at == nullptr) break;
    }
    benchmark::DoNotOptimize(lines);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * log.size()));
}

BENCHMARK_CAPTURE(scan, nmea, made_log());
BENCHMARK_CAPTURE(decode, nmea, made_log());
BENCHMARK_CAPTURE(scan, llh, made_llh());
BENCHMARK_CAPTURE(decode, llh, made_llh());

}  // namespace
}  // namespace plumbline

BENCHMARK_MAIN();
