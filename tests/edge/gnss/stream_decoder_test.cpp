// SPDX-License-Identifier: MIT
#include "edge/gnss/stream_decoder.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "edge/gnss/time_text.h"
#include "tests/edge/gnss/nmea_text.h"

namespace plumbline::gnss {
namespace {

struct Decoded {
  std::vector<GnssFix> fixes;
  std::vector<ByteRange> bytes;
};

std::unique_ptr<FixDecoder> decoder_into(Decoded& decoded) {
  return make_fix_decoder([&decoded](const GnssFix& fix, ByteRange bytes) {
    decoded.fixes.push_back(fix);
    decoded.bytes.push_back(bytes);
  });
}

std::string gga(const std::string& time) {
  return sentence("GNGGA," + time +
                  ",3540.1234567,N,13945.7654321,E,4,17,1.0,52.140,M,38.123,M,1.2,0001");
}

std::string llh(const std::string& seconds, const std::string& height = "90.2630") {
  return "2026/11/20 10:00:" + seconds + "   35.668724278  139.762757202    " + height +
         "   1  17   0.0110   0.0120   0.0250   0.0000   0.0000   0.0000   1.20    9.9\r\n";
}

TEST(StreamDecoder, NamesTheBytesOfAnEpochFromItsFirstSentenceToItsLast) {
  Decoded decoded;
  const auto decoder = decoder_into(decoded);
  const std::string noise = sentence("GPGSV,1,1,00");
  const std::string gst = sentence("GNGST,100000.20,1.0,,,,0.011,0.012,0.025");
  const std::string rmc = sentence("GNRMC,100000.20,A,3540.1,N,13945.7,E,0,,201126,,,D");
  decoder->feed(gga("100000.00"));
  decoder->flush();
  for (const char c : noise + gst + gga("100000.20") + rmc + noise) decoder->feed({&c, 1});
  decoder->flush();
  ASSERT_EQ(decoded.fixes.size(), 2u);
  EXPECT_EQ(decoded.bytes[0].begin, 0u);
  const std::size_t begin = gga("100000.00").size() + noise.size();
  EXPECT_EQ(decoded.bytes[1].begin, begin);
  EXPECT_EQ(decoded.bytes[1].end, begin + (gst + gga("100000.20") + rmc).size() - 2);
}

TEST(StreamDecoder, NamesTheBytesOfALineOfLlh) {
  Decoded decoded;
  const auto decoder = decoder_into(decoded);
  decoder->feed("%  header\r\n" + llh("18.200") + llh("18.400"));
  ASSERT_EQ(decoded.fixes.size(), 2u);
  EXPECT_EQ(decoded.bytes[0].begin, std::string("%  header\r\n").size());
  EXPECT_EQ(decoded.bytes[0].end, decoded.bytes[1].begin);
}

TEST(StreamDecoder, JoinsNothingAcrossACutAnywhere) {
  const std::string before = gga("100000.00");
  const std::string after = gga("100000.20");
  for (std::size_t cut = 0; cut < before.size() - 2; ++cut) {
    Decoded decoded;
    const auto decoder = decoder_into(decoded);
    decoder->feed(before.substr(0, cut));
    decoder->cut();
    decoder->feed(before.substr(cut) + after);
    decoder->cut();
    // From the checksum on a sentence is whole; from the '$' it was begun anew.
    ASSERT_EQ(decoded.fixes.size(), cut == 0 ? 2u : 1u) << cut;
    EXPECT_EQ(text_of_day_time(*decoded.fixes.back().time_of_day), "T10:00:00.20Z");
  }
}

TEST(StreamDecoder, ReadsNoLineOfLlhThatACutEndedOrThatWasBegunBefore) {
  const std::string line = llh("18.200");
  for (std::size_t cut = 1; cut < line.size() - 1; ++cut) {
    Decoded decoded;
    const auto decoder = decoder_into(decoded);
    decoder->feed("%\n" + line.substr(0, cut));
    decoder->cut();
    decoder->feed(line.substr(cut) + llh("18.400"));
    ASSERT_EQ(decoded.fixes.size(), 1u) << cut;
    EXPECT_EQ(text_of_day_time(*decoded.fixes[0].time_of_day), "T10:00:00.40Z");
  }
}

TEST(StreamDecoder, ReadsTheOtherProtocolAfterACut) {
  Decoded decoded;
  const auto decoder = decoder_into(decoded);
  decoder->feed(gga("100000.00") + gga("100000.20"));
  decoder->cut();
  decoder->feed("%\n" + llh("18.400"));
  EXPECT_EQ(decoded.fixes.size(), 3u);
  EXPECT_EQ(decoder->counters().epochs, 3u);
  EXPECT_EQ(decoder->counters().sentences, 3u);
}

TEST(StreamDecoder, FindsALineOfLlhBehindABinaryMessage) {
  Decoded decoded;
  const auto decoder = decoder_into(decoded);
  const std::string ubx("\xB5\x62\x01\x07\x08\x00\x01\n\x03$GP\x80\x11/Az", 18);
  decoder->feed("%\n" + llh("18.200"));
  for (const char* seconds : {"18.400", "18.600"}) decoder->feed(ubx + llh(seconds));
  ASSERT_EQ(decoded.fixes.size(), 3u);
  EXPECT_EQ(decoder->counters().malformed, 0u);
  EXPECT_EQ(text_of_day_time(*decoded.fixes[2].time_of_day), "T10:00:00.60Z");
}

TEST(StreamDecoder, HandsOutAnEpochOnceThoughItsBurstHadAGap) {
  Decoded decoded;
  const auto decoder = decoder_into(decoded);
  decoder->feed(gga("100000.00"));
  decoder->flush();
  decoder->feed(sentence("GNGNS,100000.00,3540.1,N,13945.7,E,RR,17,1.0,52.1,38.1,,"));
  decoder->flush();
  decoder->feed(gga("100000.20"));
  decoder->flush();
  EXPECT_EQ(decoded.fixes.size(), 2u);
}

}  // namespace
}  // namespace plumbline::gnss
