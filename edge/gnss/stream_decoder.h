// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "edge/base/fix_decoder.h"

namespace plumbline::gnss {

// Decodes what a receiver sends while it sends it: NMEA 0183, or the RTKLIB lines of Reach's LLH
// stream, told apart by the first epoch (again after each cut), with binary messages (UBX, RTCM)
// between them or not. A line of RTKLIB that was begun before the stream was, or that a cut ended,
// is none; a sentence of NMEA whose checksum arrived before a cut is one.
std::unique_ptr<FixDecoder> make_fix_decoder(FixDecoder::Sink sink);

}  // namespace plumbline::gnss
