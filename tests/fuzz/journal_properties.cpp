// SPDX-License-Identifier: MIT
#include "tests/fuzz/journal_properties.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "edge/record/entry.h"
#include "edge/record/journal.h"

namespace plumbline::fuzz {
namespace {

using record::Entry;
using record::JournalReader;
using record::JournalState;
using record::JournalSummary;

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

std::string packed(const Entry& entry) {
  std::string bytes;
  record::pack(entry, bytes);
  return bytes;
}

struct Read {
  std::vector<Entry> entries;
  JournalSummary summary;
};

std::optional<Read> read(std::string_view bytes) {
  auto reader = JournalReader::over(bytes);
  if (!reader) {
    require(!reader.error().sentence.empty(), "a refusal is said");
    return std::nullopt;
  }
  Read all;
  while (auto entry = reader->next()) all.entries.push_back(std::move(*entry));
  all.summary = reader->summary();
  return all;
}

std::string journal_of(const std::vector<Entry>& entries) {
  std::string bytes = record::journal_head();
  std::uint64_t sequence = 0;
  for (const Entry& entry : entries) record::append_entry(entry, sequence++, bytes);
  return bytes;
}

void require_summary(const Read& all, std::size_t size) {
  const JournalSummary& summary = all.summary;
  require(summary.entries == summary.unknown + all.entries.size(), "every entry is counted");
  require(summary.whole_bytes <= size, "what is whole is there");
  require(summary.skipped_bytes <= size && summary.tail_bytes <= size, "what is bad is there");
  if (summary.state != JournalState::kComplete) return;
  require(summary.tail_bytes == 0 && summary.skipped_bytes == 0, "what is complete is good");
  require(summary.whole_bytes == size, "what is complete is whole");
}

void require_same(const std::vector<Entry>& a, const std::vector<Entry>& b) {
  require(a.size() == b.size(), "what was written is read");
  for (std::size_t k = 0; k < a.size(); ++k) {
    require(packed(a[k]) == packed(b[k]), "an entry is read as it was written");
  }
}

void check_file(std::string_view bytes) {
  const auto all = read(bytes);
  if (!all) return;
  require_summary(*all, bytes.size());
  const std::string again = journal_of(all->entries);
  const auto back = read(again);
  require(back.has_value(), "a journal is read");
  require(back->summary.whole_bytes == again.size(), "a journal is whole");
  require_same(back->entries, all->entries);
}

void check_entry(std::string_view bytes) {
  if (bytes.size() < 2) return;
  const auto low = static_cast<unsigned char>(bytes[0]);
  const auto high = static_cast<unsigned char>(bytes[1]);
  const auto kind = static_cast<std::uint16_t>(low | high << 8);
  const auto entry = record::unpack(kind, bytes.substr(2));
  if (!entry) return;
  require(record::kind_of(*entry) == kind, "an entry is of its kind");
  const std::string own = packed(*entry);
  const auto back = record::unpack(kind, own);
  require(back && packed(*back) == own, "an entry keeps its bytes");

  const std::vector<Entry> twice = {*entry, *entry};
  const std::string whole = journal_of(twice);
  const std::size_t cut = 1 + low % (own.size() + 24);
  const auto rest = read(std::string_view(whole).substr(0, whole.size() - cut));
  require(rest.has_value(), "a cut journal is read");
  require_same(rest->entries, {*entry});
  require(rest->summary.skipped_bytes == 0, "a cut is no damage");
}

}  // namespace

void check_journal(std::string_view bytes) {
  check_file(bytes);
  check_entry(bytes);
}

}  // namespace plumbline::fuzz
