// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"
#include "edge/orient/precision/covariance.h"
#include "edge/orient/reliability/reliability.h"

namespace plumbline::orient {

// Something that the input claims beside the image rays, and that can be wrong as a whole.
enum class ClaimKind { kStation, kLength, kControl, kInterior };

struct Claim {
  ClaimKind kind = ClaimKind::kStation;
  int index = 0;  // slot; index in Problem::lengths or control; parameter of the interior
  bool operator==(const Claim&) const = default;
};

struct ClaimTest {
  Claim claim;
  RowsTest rows;
  Threshold threshold;
  bool believed = true;  // false: it was no part of the adjustment

  bool fails() const { return rows.dof > 0 && rows.statistic > threshold.critical; }
};

// What stands, and what is said to be wrong.
using Terms = std::vector<Term>;

// Tests each claim that took part. All that can be checked are one family for the false alarms, the
// rejected ones among them. A claim that all but alone carries a quantity (the one side-step photo
// its azimuth) has a tenth of another's share: losing it to a false alarm would cost a measurement
// that is good otherwise. Of the interior only what somebody calibrated is a claim.
std::vector<ClaimTest> test_claims(const Network& network, const TermOptions& options,
                                   const Terms& terms, const NetworkCovariance& covariance);

// The shares of the false alarms that those of `believed` and the rejected ones have together.
double family_size(const std::vector<ClaimTest>& believed, const TermOptions& options);

// Tests a claim that took no part, against the adjustment without it, in a family of that size.
ClaimTest test_rejected(const Claim& claim, const Network& network, const State& state,
                        const State& start, const TermOptions& options,
                        const NetworkCovariance& covariance, double family);

void set_believed(const Claim& claim, bool believed, const Network& network, TermOptions& options);

// "the GNSS position of photo X", "the known length from A to B", ...
std::string in_words(const Claim& claim, const Network& network);

// Where the rows of a claim are: which term of the list, and which rows. -1: it has none.
struct ClaimRows {
  int term = -1;
  int first = 0;
  int count = 0;
};
ClaimRows rows_of(const Claim& claim, const Network& network, const TermOptions& options,
                  const Terms& terms);

// Every claim that took part in the adjustment.
std::vector<Claim> believed_claims(const Network& network, const TermOptions& options,
                                   const Terms& terms);

}  // namespace plumbline::orient
