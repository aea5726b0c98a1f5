// SPDX-License-Identifier: MIT
#include "tests/architecture/include_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumbline::architecture {
namespace {

SourceFile including(const std::string& path, const std::string& header) {
  return {path, "// SPDX-License-Identifier: MIT\n#include " + header + "\n"};
}

bool arrow_allowed(const std::string& path, const std::string& header) {
  return wrong_arrows(including(path, "\"" + header + "\"")).empty();
}

TEST(IncludesOf, FindsQuotedAndAngledHeadersWithTheirLines) {
  const auto includes =
      includes_of("\n#include \"edge/base/result.h\"\n#  include <vector> // x\n");
  ASSERT_EQ(includes.size(), 2U);
  EXPECT_EQ(includes[0].header, "edge/base/result.h");
  EXPECT_TRUE(includes[0].quoted);
  EXPECT_EQ(includes[0].line, 2);
  EXPECT_EQ(includes[1].header, "vector");
  EXPECT_FALSE(includes[1].quoted);
  EXPECT_EQ(includes[1].line, 3);
}

TEST(IncludesOf, PassesOverThoseInCommentsAndRawStrings) {
  EXPECT_TRUE(includes_of("// #include <a>\n/*\n#include <b>\n*/\n").empty());
  EXPECT_TRUE(includes_of("auto text = R\"(\n#include <c>\n)\";\n").empty());
}

TEST(WrongArrows, SaysFileLineAndRule) {
  const auto violations = wrong_arrows(including("edge/orient/a.cpp", "\"sim/world.h\""));
  ASSERT_EQ(violations.size(), 1U);
  EXPECT_EQ(testing::PrintToString(violations[0]),
            "edge/orient/a.cpp:2: includes sim/world.h: edge includes nothing of the project but "
            "edge");
}

TEST(WrongArrows, EdgeRoomsIncludeOnlyWhatLiesBelowThem) {
  EXPECT_TRUE(arrow_allowed("edge/orient/a.cpp", "edge/geometry/camera.h"));
  EXPECT_TRUE(arrow_allowed("edge/orient/a.cpp", "edge/orient/problem.h"));
  EXPECT_TRUE(arrow_allowed("edge/survey/a.cpp", "edge/image/tie_points.h"));
  EXPECT_FALSE(arrow_allowed("edge/orient/a.cpp", "edge/image/tie_points.h"));
  EXPECT_FALSE(arrow_allowed("edge/image/a.cpp", "edge/geometry/camera.h"));
  EXPECT_FALSE(arrow_allowed("edge/base/a.h", "edge/geometry/camera.h"));
  EXPECT_FALSE(arrow_allowed("edge/geometry/a.h", "edge/orient/problem.h"));
}

TEST(WrongArrows, RoomsOfOrientIncludeOnlyWhatLiesBelowThem) {
  EXPECT_TRUE(arrow_allowed("edge/orient/a.cpp", "edge/orient/start/a.h"));
  EXPECT_TRUE(arrow_allowed("edge/orient/reliability/a.h", "edge/orient/precision/a.h"));
  EXPECT_TRUE(arrow_allowed("edge/orient/network/a.cpp", "edge/orient/network/b.h"));
  EXPECT_TRUE(arrow_allowed("edge/orient/network/a.cpp", "edge/orient/problem.h"));
  EXPECT_TRUE(arrow_allowed("edge/orient/paper/a.cpp", "edge/orient/adjust.h"));
  EXPECT_TRUE(arrow_allowed("edge/plan/a.cpp", "edge/orient/network/a.h"));
  EXPECT_FALSE(arrow_allowed("edge/orient/network/a.cpp", "edge/orient/adjust.h"));
  EXPECT_FALSE(arrow_allowed("edge/orient/network/a.cpp", "edge/orient/start/a.h"));
  EXPECT_FALSE(arrow_allowed("edge/orient/precision/a.cpp", "edge/orient/reliability/a.h"));
  EXPECT_FALSE(arrow_allowed("edge/orient/start/a.cpp", "edge/orient/findings/a.h"));
  EXPECT_FALSE(arrow_allowed("edge/orient/a.cpp", "edge/orient/paper/a.h"));
  EXPECT_FALSE(arrow_allowed("edge/orient/clouds/a.cpp", "edge/orient/network/a.h"));
}

TEST(WrongArrows, EdgeKnowsNeitherDevicesNorSimulationNorPrograms) {
  EXPECT_FALSE(arrow_allowed("edge/survey/a.cpp", "drivers/camera.h"));
  EXPECT_FALSE(arrow_allowed("edge/survey/a.cpp", "sim/world.h"));
  EXPECT_FALSE(arrow_allowed("edge/survey/a.cpp", "firmware/deliver/product.h"));
}

TEST(WrongArrows, ANewRoomOfEdgeMustDeclareWhatItIncludes) {
  EXPECT_FALSE(arrow_allowed("edge/clouds/a.cpp", "edge/base/result.h"));
}

TEST(WrongArrows, DriversSeeTheSeamsTheBaseAndThemselves) {
  EXPECT_TRUE(arrow_allowed("drivers/gnss/a.cpp", "drivers/gnss_receiver.h"));
  EXPECT_TRUE(arrow_allowed("drivers/gnss/a.cpp", "drivers/gnss/port.h"));
  EXPECT_TRUE(arrow_allowed("drivers/camera.h", "edge/base/image.h"));
  EXPECT_FALSE(arrow_allowed("drivers/gnss/a.cpp", "edge/gnss/nmea_parser.h"));
  EXPECT_FALSE(arrow_allowed("drivers/gnss/a.cpp", "drivers/posix/file.h"));
  EXPECT_FALSE(arrow_allowed("drivers/camera.h", "drivers/posix/file.h"));
}

TEST(WrongArrows, TheSimulationSeesTheSeamsAndTheMathematicsOnly) {
  EXPECT_TRUE(arrow_allowed("sim/flight.cpp", "edge/geometry/camera.h"));
  EXPECT_TRUE(arrow_allowed("sim/flight.cpp", "drivers/camera.h"));
  EXPECT_FALSE(arrow_allowed("sim/flight.cpp", "drivers/posix/file.h"));
  EXPECT_FALSE(arrow_allowed("sim/flight.cpp", "firmware/ingest/number.h"));
}

TEST(WrongArrows, OnlyTheSimulatingCommandsIncludeTheSimulation) {
  EXPECT_TRUE(arrow_allowed("firmware/commands/sim_command.cpp", "sim/flight.h"));
  EXPECT_TRUE(arrow_allowed("firmware/devices_in_sim.cpp", "sim/flight.h"));
  EXPECT_FALSE(arrow_allowed("firmware/commands/measure_command.cpp", "sim/flight.h"));
}

TEST(WrongArrows, OnlyTheBoardsProgramIncludesRealDevices) {
  EXPECT_TRUE(arrow_allowed("firmware/devices_on_board.cpp", "drivers/posix/file.h"));
  EXPECT_TRUE(arrow_allowed("firmware/session.cpp", "drivers/camera.h"));
  EXPECT_FALSE(arrow_allowed("firmware/session.cpp", "drivers/posix/file.h"));
}

TEST(WrongArrows, RoomsOfFirmwareIncludeOnlyWhatLiesBelowThem) {
  EXPECT_TRUE(arrow_allowed("firmware/service/daemon.cpp", "firmware/flight/session.h"));
  EXPECT_TRUE(arrow_allowed("firmware/plumbline.cpp", "firmware/service/daemon.h"));
  EXPECT_TRUE(arrow_allowed("firmware/commands/a.cpp", "firmware/devices_on_board.h"));
  EXPECT_FALSE(arrow_allowed("firmware/flight/a.cpp", "firmware/devices_on_board.h"));
  EXPECT_FALSE(arrow_allowed("firmware/flight/session.cpp", "firmware/service/daemon.h"));
  EXPECT_FALSE(arrow_allowed("firmware/ingest/number.cpp", "firmware/deliver/product.h"));
  EXPECT_FALSE(arrow_allowed("firmware/commands/a.cpp", "firmware/service/daemon.h"));
  EXPECT_FALSE(arrow_allowed("firmware/clouds/a.cpp", "firmware/ingest/number.h"));
}

TEST(WrongArrows, RoomsOfTheDaemonShareTheFolderOfFlightsAlone) {
  EXPECT_TRUE(arrow_allowed("firmware/service/daemon.cpp", "firmware/service/status/a.h"));
  EXPECT_TRUE(arrow_allowed("firmware/service/advice/a.cpp", "firmware/service/disk/a.h"));
  EXPECT_FALSE(arrow_allowed("firmware/service/advice/a.cpp", "firmware/service/status/a.h"));
  EXPECT_FALSE(arrow_allowed("firmware/service/disk/a.cpp", "firmware/service/daemon.h"));
}

TEST(WrongArrows, NothingButTestsIncludesTests) {
  EXPECT_FALSE(arrow_allowed("firmware/session.cpp", "tests/fakes.h"));
  EXPECT_TRUE(arrow_allowed("tests/sim/a_test.cpp", "tests/fakes.h"));
}

TEST(WrongArrows, HeadersAreNamedFromTheRootExceptATestsNeighbour) {
  EXPECT_TRUE(arrow_allowed("tests/sim/a_test.cpp", "small_flight.h"));
  EXPECT_FALSE(arrow_allowed("edge/base/parallel.cpp", "parallel.h"));
  EXPECT_FALSE(arrow_allowed("edge/orient/a.cpp", "../base/result.h"));
}

TEST(StrayedLibraries, OpenCvStaysInTheImageRoomAndCeresInTests) {
  EXPECT_TRUE(strayed_libraries(including("edge/image/a.cpp", "<opencv2/core.hpp>")).empty());
  EXPECT_FALSE(strayed_libraries(including("edge/orient/a.cpp", "<opencv2/core.hpp>")).empty());
  EXPECT_TRUE(strayed_libraries(including("tests/bench/a.cpp", "<ceres/ceres.h>")).empty());
  EXPECT_FALSE(strayed_libraries(including("edge/orient/a.cpp", "<ceres/ceres.h>")).empty());
}

TEST(ImpureMathematics, FindsFileAndClockHeadersInEdgeAndSimOnly) {
  EXPECT_FALSE(impure_mathematics(including("edge/base/a.h", "<fstream>")).empty());
  EXPECT_FALSE(impure_mathematics(including("sim/a.cpp", "<sys/stat.h>")).empty());
  EXPECT_TRUE(impure_mathematics(including("edge/base/a.h", "<chrono>")).empty());
  EXPECT_TRUE(impure_mathematics(including("firmware/a.cpp", "<fstream>")).empty());
}

TEST(ImpureMathematics, FindsCallsButNotWordsLikeThem) {
  const auto impure = [](const std::string& code) {
    return !impure_mathematics({"edge/base/a.cpp", code}).empty();
  };
  EXPECT_TRUE(impure("auto t = std::chrono::steady_clock::now();"));
  EXPECT_TRUE(impure("std::random_device device;"));
  EXPECT_TRUE(impure("getenv(\"HOME\");"));
  EXPECT_FALSE(impure("// it is ::now() that counts"));
  EXPECT_FALSE(impure("int ecosystem = 1; double knowing = 2;"));
}

}  // namespace
}  // namespace plumbline::architecture
