// SPDX-License-Identifier: MIT
#include "edge/gnss/stream_decoder.h"

#include <optional>
#include <utility>

#include "edge/gnss/log_parser.h"

namespace plumbline::gnss {
namespace {

DecoderCounters sum_of(const DecoderCounters& a, const DecoderCounters& b) {
  return {a.bytes + b.bytes, a.sentences + b.sentences, a.bad_checksum + b.bad_checksum,
          a.malformed + b.malformed, a.epochs + b.epochs};
}

// One LogParser from cut to cut.
class StreamDecoder : public FixDecoder {
 public:
  explicit StreamDecoder(Sink sink) : sink_(std::move(sink)) { begin(); }

  void feed(std::string_view bytes) override { parser_->feed(bytes); }
  void flush() override { parser_->flush(); }

  void cut() override {
    parser_->cut();
    before_ = counters();
    begin();
  }

  DecoderCounters counters() const override { return sum_of(before_, parser_->counters()); }

 private:
  void begin() {
    parser_.emplace([this](const GnssFix& fix) { hand_on(fix); });
    parser_->begin_amid_a_line();
  }

  void hand_on(const GnssFix& fix) {
    const ByteRange bytes = parser_->epoch_bytes();
    sink_(fix, {before_.bytes + bytes.begin, before_.bytes + bytes.end});
  }

  Sink sink_;
  std::optional<LogParser> parser_;
  DecoderCounters before_;  // of the parsers before the last cut
};

}  // namespace

std::unique_ptr<FixDecoder> make_fix_decoder(FixDecoder::Sink sink) {
  return std::make_unique<StreamDecoder>(std::move(sink));
}

}  // namespace plumbline::gnss
