// SPDX-License-Identifier: MIT
#include "firmware/flight/journal_file.h"

#include <utility>

namespace plumbline::flight {

JournalFile::JournalFile(Storage& storage, std::string path, std::uint64_t durable)
    : storage_(storage), path_(std::move(path)), durable_(durable) {}

void JournalFile::append(std::string_view bytes) { waiting_.append(bytes); }

Status JournalFile::broken(Error error) {
  file_.reset();
  written_ = 0;
  in_doubt_ = true;
  return error;
}

void JournalFile::start_over(std::string_view head) {
  file_.reset();
  waiting_ = head;
  written_ = 0;
  durable_ = 0;
  in_doubt_ = true;
}

Status JournalFile::open() {
  if (file_) return Done{};
  if (in_doubt_) {
    if (const Status cut = storage_.truncate(path_, durable_); !cut) return cut;
    in_doubt_ = false;
  }
  auto file = storage_.append_to(path_);
  if (!file) return file.error();
  file_ = std::move(file).value();
  return Done{};
}

Status JournalFile::write() {
  if (const Status opened = open(); !opened) return opened;
  if (written_ == waiting_.size()) return Done{};
  const Status appended = file_->append(std::string_view(waiting_).substr(written_));
  if (!appended) return broken(appended.error());
  written_ = waiting_.size();
  return Done{};
}

Status JournalFile::flush() { return write(); }

Status JournalFile::sync() {
  if (waiting_.empty()) return Done{};
  if (const Status good = write(); !good) return good;
  if (const Status synced = file_->sync(); !synced) return broken(synced.error());
  durable_ += waiting_.size();
  waiting_.clear();
  written_ = 0;
  return Done{};
}

}  // namespace plumbline::flight
