#include "core/math/median.h"

#include <gtest/gtest.h>

namespace pinocchio {
namespace {

TEST(Median, IsTheMiddleOfAnOddNumber) {
  EXPECT_EQ(median(std::vector{7.0}), 7.0);
  EXPECT_EQ(median(std::vector{9.0, -1.0, 4.0}), 4.0);
  EXPECT_EQ(median(std::vector{5.0f, 1.0f, 5.0f, 100.0f, 2.0f}), 5.0f);
}

TEST(Median, IsTheMeanOfTheTwoInTheMiddleOfAnEvenNumber) {
  EXPECT_EQ(median(std::vector{3.0, 1.0}), 2.0);
  EXPECT_EQ(median(std::vector{8.0, 100.0, 1.0, 2.0}), 5.0);
  EXPECT_EQ(median(std::vector{1.0f, 1.0f, 1.0f, 9.0f}), 1.0f);
}

}  // namespace
}  // namespace pinocchio
