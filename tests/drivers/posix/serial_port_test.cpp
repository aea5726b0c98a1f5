// SPDX-License-Identifier: MIT
#include "drivers/posix/serial_port.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <termios.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "drivers/posix/file_stream.h"
#include "drivers/posix/serial_port_list.h"
#include "drivers/posix/tcp_stream.h"
#include "sim/pty_port.h"

namespace plumbline::posix {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using testing::HasSubstr;
using Arrival = ByteStream::Arrival;
using Presence = ByteStream::Presence;

// A folder of its own, and in it a port.
class SerialPortTest : public testing::Test {
 protected:
  SerialPortTest() : folder_(new_folder()), cable_((folder_ / "ttyRTK").string()) {}
  ~SerialPortTest() override {
    cable_.pull();
    fs::remove_all(folder_);
  }

  static fs::path new_folder() {
    std::string name = (fs::temp_directory_path() / "plumbline-port-XXXXXX").string();
    return ::mkdtemp(name.data());
  }

  termios settings_of_port() const {
    const Descriptor other(::open(cable_.path().c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK));
    termios settings{};
    EXPECT_EQ(::tcgetattr(other.get(), &settings), 0);
    return settings;
  }

  fs::path folder_;
  sim::PtyPort cable_;
};

TEST_F(SerialPortTest, SendsEveryByteAsItIs) {
  ASSERT_TRUE(cable_.plug_in());
  SerialPort port(cable_.path());
  EXPECT_EQ(port.write("not open"), 0u);
  ASSERT_EQ(port.open().presence, Presence::kOpen);
  std::string sent;
  for (int c = 0; c < 256; ++c) sent.push_back(static_cast<char>(c));
  EXPECT_EQ(port.write(sent), sent.size());
  EXPECT_EQ(cable_.received(), sent);
}

TEST_F(SerialPortTest, TakesNothingForALineThatIsFull) {
  ASSERT_TRUE(cable_.plug_in());
  SerialPort port(cable_.path());
  ASSERT_EQ(port.open().presence, Presence::kOpen);
  const std::string much(100000, 'x');
  std::size_t taken = 0;
  for (std::size_t last = 1; last > 0;) {
    last = port.write(std::string_view(much).substr(taken));
    taken += last;
  }
  EXPECT_LT(taken, much.size());
  EXPECT_EQ(cable_.received().size(), taken);
  EXPECT_GT(port.write("there is room again"), 0u);
}

TEST_F(SerialPortTest, TakesNothingForAPortThatHasGone) {
  ASSERT_TRUE(cable_.plug_in());
  SerialPort port(cable_.path());
  ASSERT_EQ(port.open().presence, Presence::kOpen);
  cable_.pull();
  EXPECT_EQ(port.write("anybody"), 0u);
  EXPECT_EQ(port.read(seconds(1)).arrival, Arrival::kGone);
}

TEST_F(SerialPortTest, HandsOnEveryByteAsItIs) {
  ASSERT_TRUE(cable_.plug_in());
  SerialPort port(cable_.path());
  ASSERT_EQ(port.open().presence, Presence::kOpen);
  std::string sent;
  for (int c = 0; c < 256; ++c) sent.push_back(static_cast<char>(c));
  cable_.send(sent);
  std::string got;
  while (got.size() < sent.size()) {
    const auto reading = port.read(seconds(5));
    ASSERT_EQ(reading.arrival, Arrival::kBytes);
    got += reading.bytes;
  }
  EXPECT_EQ(got, sent);
}

TEST_F(SerialPortTest, SaysThatThePortHasGoneAndClosesIt) {
  ASSERT_TRUE(cable_.plug_in());
  SerialPort port(cable_.path());
  ASSERT_EQ(port.open().presence, Presence::kOpen);
  cable_.pull();
  const auto reading = port.read(seconds(5));
  EXPECT_EQ(reading.arrival, Arrival::kGone);
  EXPECT_THAT(reading.sentence, HasSubstr("has gone"));
  EXPECT_EQ(port.read(seconds(5)).arrival, Arrival::kGone);  // and does not wait
}

TEST_F(SerialPortTest, ReturnsToRawModeAndItsSpeedAfterAReplug) {
  SerialPort port(cable_.path());
  ASSERT_TRUE(port.set_speed(38400));
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(cable_.plug_in());
    ASSERT_EQ(port.open().presence, Presence::kOpen);
    const termios settings = settings_of_port();
    EXPECT_EQ(settings.c_lflag & (ICANON | ECHO | ISIG), 0u);
    EXPECT_EQ(settings.c_iflag & (IXON | ICRNL | INLCR), 0u);
    EXPECT_EQ(settings.c_oflag & OPOST, 0u);
    EXPECT_EQ(::cfgetispeed(&settings), static_cast<speed_t>(B38400));
    cable_.pull();
    EXPECT_EQ(port.read(seconds(5)).arrival, Arrival::kGone);
  }
}

TEST_F(SerialPortTest, TakesEveryUsualSpeedAndNoOther) {
  ASSERT_TRUE(cable_.plug_in());
  SerialPort port(cable_.path());
  ASSERT_EQ(port.open().presence, Presence::kOpen);
  for (const int baud : {4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600}) {
    EXPECT_TRUE(port.set_speed(baud)) << baud;
  }
  EXPECT_EQ(port.speeds().size(), 9u);
  const Status odd = port.set_speed(12345);
  ASSERT_FALSE(odd);
  EXPECT_THAT(odd.error().sentence, HasSubstr("choose 4800"));
}

TEST_F(SerialPortTest, IsOpenForOneProgramOnly) {
  ASSERT_TRUE(cable_.plug_in());
  SerialPort first(cable_.path());
  ASSERT_EQ(first.open().presence, Presence::kOpen);
  SerialPort second(cable_.path());
  const auto refused = second.open();
  EXPECT_EQ(refused.presence, Presence::kRefused);
  EXPECT_THAT(refused.sentence, HasSubstr("held open by another program"));
  first.close();
  EXPECT_EQ(second.open().presence, Presence::kOpen);
}

TEST_F(SerialPortTest, IsAbsentWhereThereIsNoNode) {
  SerialPort port(cable_.path());
  const auto absent = port.open();
  EXPECT_EQ(absent.presence, Presence::kAbsent);
  EXPECT_THAT(absent.sentence, HasSubstr("There is no port " + cable_.path()));
}

TEST_F(SerialPortTest, RefusesWhatIsNoPort) {
  const fs::path file = folder_ / "file";
  std::ofstream(file) << "no port";
  for (const std::string& path : {file.string(), std::string("/dev/null"), folder_.string()}) {
    SerialPort port(path);
    const auto refused = port.open();
    EXPECT_EQ(refused.presence, Presence::kRefused) << path;
    EXPECT_THAT(refused.sentence, HasSubstr("is not a serial port")) << path;
  }
}

TEST_F(SerialPortTest, WaitsNoLongerThanItIsToldAndEndsWhenInterrupted) {
  ASSERT_TRUE(cable_.plug_in());
  SerialPort port(cable_.path());
  ASSERT_EQ(port.open().presence, Presence::kOpen);
  EXPECT_EQ(port.read(std::chrono::milliseconds(1)).arrival, Arrival::kNothing);
  std::thread other([&] { port.interrupt(); });
  EXPECT_EQ(port.read(std::chrono::hours(1)).arrival, Arrival::kNothing);
  other.join();
}

TEST(FileStream, ReadsALogToItsEnd) {
  const fs::path path = fs::temp_directory_path() / ("plumbline-log-" + std::to_string(::getpid()));
  const std::string text(200000, 'x');
  std::ofstream(path) << text;
  FileStream log(path.string());
  ASSERT_EQ(log.open().presence, Presence::kOpen);
  std::size_t count = 0;
  for (auto reading = log.read(seconds(1)); reading.arrival != Arrival::kEnd;
       reading = log.read(seconds(1))) {
    count += reading.bytes.size();
  }
  EXPECT_EQ(count, text.size());
  fs::remove(path);
  EXPECT_EQ(log.open().presence, Presence::kRefused);
}

TEST(TcpStream, IsAbsentWhereNobodyListensAndRefusesAPortThatIsNone) {
  EXPECT_EQ(TcpStream("127.0.0.1", "1").open().presence, Presence::kAbsent);
  EXPECT_EQ(TcpStream("127.0.0.1", "nmea").open().presence, Presence::kRefused);
}

// A sysfs of two USB ports, a UART, one that the board lacks, a console and a terminal.
class FakeSysfs {
 public:
  explicit FakeSysfs(fs::path root) : root_(std::move(root)) {
    add_port("ttyACM0", "usb1/1-1/1-1:1.0");
    describe("usb1/1-1", {{"idVendor", "3032"},
                          {"idProduct", "0010"},
                          {"serial", "8243A1"},
                          {"manufacturer", "Emlid"},
                          {"product", "ReachM+"}});
    add_port("ttyUSB0", "usb1/1-2/1-2:1.0/ttyUSB0");
    describe("usb1/1-2", {{"idVendor", "0403"}, {"idProduct", "6001"}});
    add_port("ttyS0", "serial8250");
    write("class/tty/ttyS0/type", "4");
    add_port("ttyS1", "serial8250");
    write("class/tty/ttyS1/type", "0");
    fs::create_directories(root_ / "class/tty/console");
    fs::create_directories(root_ / "class/tty/tty1");
  }

 private:
  void add_port(const std::string& name, const std::string& device) {
    fs::create_directories(root_ / "devices" / device);
    fs::create_directories(root_ / "class/tty" / name);
    fs::create_directory_symlink(root_ / "devices" / device, root_ / "class/tty" / name / "device");
  }
  void describe(const std::string& device,
                const std::vector<std::pair<std::string, std::string>>& attributes) {
    for (const auto& [name, text] : attributes) write("devices/" + device + "/" + name, text);
  }
  void write(const std::string& path, const std::string& text) {
    std::ofstream(root_ / path) << text << '\n';
  }

  fs::path root_;
};

TEST_F(SerialPortTest, IsListedWithWhatItsUsbDeviceSaysOfItself) {
  const FakeSysfs sysfs(folder_ / "sys");
  const std::vector<SerialPortInfo> ports = list_serial_ports(folder_ / "sys");
  ASSERT_EQ(ports.size(), 3u);
  EXPECT_EQ(ports[0].path, "/dev/ttyACM0");
  EXPECT_EQ(ports[0].vid + ":" + ports[0].pid, "3032:0010");
  EXPECT_EQ(ports[0].serial, "8243A1");
  EXPECT_EQ(ports[0].manufacturer, "Emlid");
  EXPECT_EQ(ports[0].product, "ReachM+");
  EXPECT_EQ(ports[1].path, "/dev/ttyS0");
  EXPECT_TRUE(ports[1].vid.empty());
  EXPECT_EQ(ports[2].path, "/dev/ttyUSB0");
  EXPECT_EQ(ports[2].vid, "0403");
  EXPECT_TRUE(ports[2].serial.empty());
  EXPECT_TRUE(list_serial_ports(folder_ / "none").empty());
}

}  // namespace
}  // namespace plumbline::posix
