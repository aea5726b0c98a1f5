// SPDX-License-Identifier: MIT
#include "edge/base/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace plumbline {
namespace {

Result<int> half(int number) {
  if (number % 2 != 0) return Error{"The number is odd; give an even one."};
  return number / 2;
}

TEST(Result, HoldsTheValueOfGoodWork) {
  const Result<int> result = half(6);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(static_cast<bool>(result));
  EXPECT_EQ(result.value(), 3);
  EXPECT_EQ(*result, 3);
}

TEST(Result, HoldsTheSentenceOfFailedWork) {
  const Result<int> result = half(5);
  ASSERT_FALSE(result.ok());
  EXPECT_FALSE(static_cast<bool>(result));
  EXPECT_EQ(result.error().sentence, "The number is odd; give an even one.");
}

TEST(Result, LetsTheValueBeChangedInPlace) {
  Result<std::string> result = std::string("plumb");
  *result += "line";
  EXPECT_EQ(result->size(), 9U);
  EXPECT_EQ(result.value(), "plumbline");
}

TEST(Result, HandsOverAValueThatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(7);
  const std::unique_ptr<int> owned = std::move(result).value();
  EXPECT_EQ(*owned, 7);
}

TEST(Result, OfWorkWithoutAValueIsDoneOrAnError) {
  const Status good = Done{};
  const Status bad = Error{"The disk is full; free 2 MB."};
  EXPECT_TRUE(good.ok());
  EXPECT_FALSE(bad.ok());
}

TEST(ResultDeathTest, AbortsWhereTheValueOfAFailureIsRead) {
  const Result<int> failed = half(5);
  EXPECT_DEATH(static_cast<void>(failed.value()), "");
}

TEST(ResultDeathTest, AbortsWhereTheErrorOfASuccessIsRead) {
  const Result<int> good = half(6);
  EXPECT_DEATH(static_cast<void>(good.error()), "");
}

}  // namespace
}  // namespace plumbline
