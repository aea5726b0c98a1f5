// SPDX-License-Identifier: MIT
// What a single word of the file may be: a key that was nearly hit, a place, a text in a sentence.
#include <gtest/gtest.h>

#include "firmware/config/nearest.h"
#include "firmware/config/places.h"
#include "firmware/config/value.h"

namespace plumbline::config {
namespace {

const std::vector<std::string_view> kWords = {"address", "latency_s", "heights_m", "gain"};

TEST(Nearest, ForgivesALetterTooFewTooManyChangedOrExchanged) {
  EXPECT_EQ(nearest("adress", kWords), "address");
  EXPECT_EQ(nearest("addresss", kWords), "address");
  EXPECT_EQ(nearest("aDdrezs", kWords), "address");
  EXPECT_EQ(nearest("gian", kWords), "gain");
  EXPECT_EQ(nearest("latency_ms", kWords), "latency_s");
  EXPECT_EQ(nearest("height_m", kWords), "heights_m");
}

TEST(Nearest, TakesTheBeginningOfAWord) {
  EXPECT_EQ(nearest("addr", kWords), "address");
  EXPECT_EQ(nearest("latency", kWords), "latency_s");
}

TEST(Nearest, MakesNothingOfAWordLikeNoOther) {
  EXPECT_EQ(nearest("xyzzy", kWords), std::nullopt);
  EXPECT_EQ(nearest("", kWords), std::nullopt);
  EXPECT_EQ(nearest(std::string(50'000, 'a'), kWords), std::nullopt);
}

TEST(Places, AReceiverIsOnAPortOrInTheNetwork) {
  for (const char* good : {"/dev/ttyACM0", "/dev/ttyUSB0@38400", "tcp://192.168.42.1:9001",
                           "tcp://[::1]:9001", "tcp://reach.local:9001"}) {
    EXPECT_TRUE(is_receiver_address(good)) << good;
  }
  for (const char* bad : {"", "ttyACM0", "/dev/ttyACM0@fast", "/dev/ttyACM0@", "/dev/ttyACM0@0",
                          "tcp://", "tcp://host", "tcp://:9001", "tcp://host:", "tcp://host:70000",
                          "tcp://a b:1", "udp://host:1", "/dev/"}) {
    EXPECT_FALSE(is_receiver_address(bad)) << bad;
  }
}

TEST(Places, AnAutopilotIsOnAPortOrByUdp) {
  for (const char* good : {"", "udp://127.0.0.1:14550", "/dev/ttyAMA1@57600", "/dev/ttyAMA1"}) {
    EXPECT_TRUE(is_pilot_link_or_empty(good)) << good;
  }
  for (const char* bad : {"tcp://host:1", "udp://host", "ttyAMA1", " "}) {
    EXPECT_FALSE(is_pilot_link_or_empty(bad)) << bad;
  }
}

TEST(Places, ALineIsAChipAndNumberOrAName) {
  for (const char* good : {"", "/dev/gpiochip0:17", "gpiochip0:17", "SHUTTER", "GPIO 17"}) {
    EXPECT_TRUE(is_gpio_line_or_empty(good)) << good;
  }
  for (const char* bad : {"/dev/gpiochip0", "gpiochip0:", "gpiochip0:-1", ":17", "gpio:SHUTTER",
                          "gpiochip0:17 ", "a\nb"}) {
    EXPECT_FALSE(is_gpio_line_or_empty(bad)) << bad;
  }
}

TEST(Places, APulsePerSecondIsOnALineOrADevice) {
  for (const char* good : {"", "gpio:/dev/gpiochip0:18", "gpio:PPS", "/dev/pps0"}) {
    EXPECT_TRUE(is_pps_or_empty(good)) << good;
  }
  for (const char* bad : {"pps0", "gpio:", "gpio:/dev/gpiochip0", "18"}) {
    EXPECT_FALSE(is_pps_or_empty(bad)) << bad;
  }
}

TEST(Places, ASocketsPathFitsItsAddress) {
  EXPECT_TRUE(is_socket_path("/" + std::string(106, 's')));
  EXPECT_FALSE(is_socket_path("/" + std::string(107, 's')));
  EXPECT_TRUE(is_absolute_path("/" + std::string(199, 's')));
  EXPECT_FALSE(is_absolute_path("/" + std::string(200, 's')));
}

TEST(Shown, IsOneLineAndNotLong) {
  EXPECT_EQ(shown("a\nb\x7f"), "a?b?");
  EXPECT_EQ(shown(std::string(1000, 'x')), std::string(60, 'x') + "...");
}

TEST(Shown, CutsNoCharacterInTwo) {
  std::string text(59, 'x');
  text += "\u00b5\u00b5";  // two bytes each: the first lies across the limit
  EXPECT_EQ(shown(text), std::string(59, 'x') + "...");
}

}  // namespace
}  // namespace plumbline::config
