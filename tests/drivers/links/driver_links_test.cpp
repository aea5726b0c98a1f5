// SPDX-License-Identifier: MIT
#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <link.h>

#include <cstdio>
#include <string>
#include <vector>

namespace plumbline {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

int note_library(dl_phdr_info* library, std::size_t /*size*/, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(library->dlpi_name);
  return 0;
}

// Every shared library in this process: those of the program, and those that they want in turn.
std::vector<std::string> loaded_libraries() {
  std::vector<std::string> names;
  ::dl_iterate_phdr(note_library, &names);
  return names;
}

const auto kFromTheMeasuringSide =
    AnyOf(HasSubstr("opencv"), HasSubstr("gdal"), HasSubstr("exiv2"), HasSubstr("ceres"));

TEST(DriverLinks, BringNoLibraryOfTheMeasuringSide) {
  const auto libraries = loaded_libraries();
  EXPECT_THAT(libraries, Contains(HasSubstr("libgpiod")));
  EXPECT_THAT(libraries, Each(Not(kFromTheMeasuringSide)));
}

TEST(DriverLinks, LeaveLibcameraToItsModule) {
  EXPECT_THAT(loaded_libraries(), Each(Not(HasSubstr("libcamera"))));
}

// The list of the daemon itself, as the dynamic linker reads it.
TEST(DaemonLinks, HaveNoLibraryOfTheMeasuringSide) {
  const std::string command = std::string("ldd ") + PLUMBLINE_DAEMON;
  std::FILE* list = ::popen(command.c_str(), "r");
  ASSERT_NE(list, nullptr);
  std::string text;
  for (int c = std::fgetc(list); c != EOF; c = std::fgetc(list)) text += static_cast<char>(c);
  ASSERT_EQ(::pclose(list), 0);
  EXPECT_THAT(text, HasSubstr("libgpiod"));
  EXPECT_THAT(text, Not(kFromTheMeasuringSide));
  EXPECT_THAT(text, Not(HasSubstr("libcamera")));
}

#ifdef PLUMBLINE_CAMERA_MODULE
TEST(DriverLinks, BringNoneWithTheLibcameraModuleEither) {
  void* module = ::dlopen(PLUMBLINE_CAMERA_MODULE, RTLD_NOW);
  ASSERT_NE(module, nullptr) << ::dlerror();
  const auto libraries = loaded_libraries();
  ::dlclose(module);
  EXPECT_THAT(libraries, Contains(HasSubstr("libcamera.so")));
  EXPECT_THAT(libraries, Each(Not(kFromTheMeasuringSide)));
}
#endif

}  // namespace
}  // namespace plumbline
