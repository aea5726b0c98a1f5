// SPDX-License-Identifier: MIT
// Expectations: the protocol as sd_notify(3) describes it.
#include "firmware/service/life/service_manager.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/firmware/ingest/temporary_folder.h"
#include "tests/firmware/service/life/notify_socket.h"

namespace plumbline::service {
namespace {

using ::testing::ElementsAre;

TEST(ServiceManager, IsToldEachThingInADatagramOfItsOwn) {
  const ingest::TemporaryFolder folder;
  NotifySocket socket(folder / "notify");
  const ServiceManager manager;
  EXPECT_TRUE(manager.ready("Waiting for a position."));
  EXPECT_TRUE(manager.lives());
  EXPECT_TRUE(manager.show("Ready: fixed."));
  EXPECT_TRUE(manager.stopping());
  EXPECT_THAT(socket.all(), ElementsAre("READY=1\nSTATUS=Waiting for a position.", "WATCHDOG=1",
                                        "STATUS=Ready: fixed.", "STOPPING=1"));
}

// Else the second line of a sentence would be an order of its own.
TEST(ServiceManager, IsToldASentenceInOneLine) {
  const ingest::TemporaryFolder folder;
  NotifySocket socket(folder / "notify");
  EXPECT_TRUE(ServiceManager().show("one\nSTOPPING=1"));
  EXPECT_THAT(socket.all(), ElementsAre("STATUS=one STOPPING=1"));
}

TEST(ServiceManager, IsNotMissedWhereThereIsNone) {
  EXPECT_FALSE(ServiceManager().is_there());
  EXPECT_TRUE(ServiceManager().lives());
}

TEST(ServiceManager, ThatHasGoneIsAnError) {
  const ingest::TemporaryFolder folder;
  NotifySocket socket(folder / "notify");
  ::setenv("NOTIFY_SOCKET", (folder / "another").c_str(), 1);
  EXPECT_FALSE(ServiceManager().lives());
}

}  // namespace
}  // namespace plumbline::service
