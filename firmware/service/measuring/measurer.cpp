// SPDX-License-Identifier: MIT
#include "firmware/service/measuring/measurer.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

namespace plumbline::service {
namespace {

using namespace std::chrono_literals;

std::string program_path(const std::string& wanted) {
  if (!wanted.empty()) return wanted;
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto beside = self.parent_path() / "plumbline";
  return std::filesystem::exists(beside, error) ? beside.string() : "plumbline";
}

// ioprio_set(2); the kernel's header of these does not compile as C++.
constexpr int kIoprioWhoProcess = 1;
constexpr int kIoprioClassIdle = 3 << 13;

constexpr const char* kLog = "/measure.log";
constexpr const char* kResultFolder = "/result";

constexpr std::string_view kResult = "Measured from ";

// Of a sentence about a result.
int photos_of(std::string_view sentence) {
  int photos = 0;
  sentence.remove_prefix(kResult.size());
  std::from_chars(sentence.data(), sentence.data() + sentence.size(), photos);
  return photos;
}

// The sentences about results in the log of a process that is still writing it.
class ResultLines {
 public:
  explicit ResultLines(const std::string& path) : path_(path) {}

  std::optional<std::string> next() {
    std::ifstream file(path_);
    file.seekg(read_);
    std::string line;
    while (std::getline(file, line) && !file.eof()) {  // a line that is whole
      read_ += static_cast<std::streamoff>(line.size()) + 1;
      if (line.starts_with(kResult)) return line;
    }
    return std::nullopt;
  }

 private:
  std::string path_;
  std::streamoff read_ = 0;
};

// In the child, before it becomes the measuring program: nothing here allocates.
void become_humble(int memory_mb) {
  ::setpriority(PRIO_PROCESS, 0, 19);
  sched_param none{};
  ::sched_setscheduler(0, SCHED_IDLE, &none);
  ::syscall(SYS_ioprio_set, kIoprioWhoProcess, 0, kIoprioClassIdle);
  const rlimit memory{static_cast<rlim_t>(memory_mb) << 20, static_cast<rlim_t>(memory_mb) << 20};
  ::setrlimit(RLIMIT_AS, &memory);
  // The first to go where memory ends.
  const int score = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (score >= 0) {
    (void)!::write(score, "1000", 4);
    ::close(score);
  }
  sigset_t none_blocked;
  sigemptyset(&none_blocked);
  ::sigprocmask(SIG_SETMASK, &none_blocked, nullptr);
}

}  // namespace

Measurer::Measurer(const MeasurerOptions& options, Events events)
    : options_(options),
      events_(std::move(events)),
      request_(options.request_file, options.longest),
      thread_([this] { run(); }) {}

Measurer::~Measurer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void Measurer::found(const FoundFlight& flight, bool is_under_way) {
  const std::lock_guard lock(mutex_);
  if (is_under_way) {
    wish_ = {flight.flight, flight.photos};
    if (!flight.is_measured) return;
    measured_flight_ = flight.flight;
    measured_photos_ = flight.photos;
  } else if (!flight.is_measured) {
    left_ = Wish{flight.flight, flight.photos, true, true};
  }
}

void Measurer::stored(const std::string& flight) {
  const std::lock_guard lock(mutex_);
  if (flight != wish_.flight) wish_ = {flight, 0};
  ++wish_.photos;
}

void Measurer::ended(const std::string& flight) {
  const std::lock_guard lock(mutex_);
  if (flight == wish_.flight) wish_.landed = true;
}

void Measurer::run() {
  for (;;) {
    std::optional<Wish> wish;
    {
      const std::lock_guard lock(mutex_);
      if (stopping_) return;
      wish = next();
    }
    look_for_answer();
    if (wish) {
      measure(*wish);
    } else {
      std::this_thread::sleep_for(100ms);
    }
  }
}

// Whether there is something new of the flight that is flown.
bool Measurer::is_due() const {
  const bool news = wish_.photos > measured_photos_ || wish_.flight != measured_flight_;
  return wish_.photos >= options_.first_at && (news || (again_ && wish_.landed));
}

std::optional<Measurer::Wish> Measurer::next() const {
  if (is_due()) return wish_;
  const bool is_flown = wish_.photos > 0 && !wish_.landed;
  return is_flown ? std::nullopt : left_;
}

void Measurer::measure(const Wish& wish) {
  {
    const std::lock_guard lock(mutex_);
    if (wish.was_left) {
      left_.reset();
    } else {
      measured_flight_ = wish.flight;
      measured_photos_ = wish.photos;
    }
  }
  if (wish.was_left && !has_ended(folder_of(wish))) {
    return events_.failed(wish.flight,
                          "It was not measured, and its recording has no end; "
                          "plumbline measure " +
                              folder_of(wish) + " measures it.");
  }
  if (wish.was_left) events_.begun(wish.flight, "It has no result yet, and is measured now.");
  if (options_.request_file.empty()) {
    measure_in_process(wish);
  } else {
    ask(wish);
  }
}

void Measurer::measure_in_process(const Wish& wish) {
  const pid_t process = spawn(folder_of(wish));
  const std::optional<int> status = process > 0 ? wait_for(process, wish) : -1;
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return;
    if (!status) {  // it gave way
      left_ = wish;
      return;
    }
    if (wish_.flight == wish.flight) measured_photos_ = wish_.photos;  // it followed them
  }
  judge(wish, *status);
}

void Measurer::judge(const Wish& wish, int status) {
  const bool good = status >= 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!wish.was_left) {
    const std::lock_guard lock(mutex_);
    again_ = !good && !wish.landed;
  }
  if (good) return;
  if (status >= 0 && WIFSIGNALED(status)) {
    events_.failed(wish.flight, "The measuring process was ended by signal " +
                                    std::to_string(WTERMSIG(status)) + "; the photos are kept.");
  } else {
    events_.failed(wish.flight, "The measuring process failed; the photos are kept, and " +
                                    folder_of(wish) + kLog + " says why.");
  }
}

// Asked again for each photo, and once more after landing: a service that was measuring when the
// file was written may not have seen it.
void Measurer::ask(const Wish& wish) {
  asked_ = wish;
  if (!wish.was_left) {
    const std::lock_guard lock(mutex_);
    again_ = !wish.landed;
  }
  if (request_.ask(folder_of(wish), wish.photos, ResultRequest::Time::clock::now())) return;
  events_.failed(wish.flight, "Cannot write " + options_.request_file + ".");
}

void Measurer::look_for_answer() {
  const auto answer = request_.answer(ResultRequest::Time::clock::now());
  if (!answer) return;
  if (answer->is_last && !asked_.was_left) {
    const std::lock_guard lock(mutex_);
    again_ = false;
  }
  if (answer->good) {
    events_.measured({asked_.flight, answer->sentence, answer->figures, asked_.was_left});
  } else {
    events_.failed(asked_.flight, answer->sentence);
  }
}

pid_t Measurer::spawn(const std::string& flight) const {
  const std::string program = program_path(options_.program);
  const std::string out = flight + kResultFolder;
  const std::string log = flight + kLog;
  std::error_code none;
  std::filesystem::remove(log, none);
  const char* const arguments[] = {program.c_str(), "measure",  flight.c_str(), "--out",
                                   out.c_str(),     "--follow", nullptr};
  const pid_t process = ::fork();
  if (process != 0) return process;
  become_humble(options_.memory_mb);
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file >= 0) {
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
  }
  ::execvp(program.c_str(), const_cast<char* const*>(arguments));
  ::_exit(127);
}

// Its status; empty where it was stopped for the sake of others.
std::optional<int> Measurer::wait_for(pid_t process, const Wish& wish) {
  const std::string folder = folder_of(wish);
  ResultLines results(folder + kLog);
  auto rested = ResultRequest::Time::clock::now();  // when nothing was due last, or a result came
  int measured = 0;
  int status = 0;
  for (;;) {
    const bool is_over = ::waitpid(process, &status, WNOHANG) == process;
    while (const auto sentence = results.next()) {
      measured = photos_of(*sentence);
      rested = ResultRequest::Time::clock::now();
      events_.measured(
          {wish.flight, *sentence, read_result(folder + kResultFolder), wish.was_left});
    }
    if (is_over) return status;
    const Stop stop = must_stop(wish, measured, rested);
    if (stop == Stop::kNo) {
      std::this_thread::sleep_for(50ms);
      continue;
    }
    ::kill(process, SIGKILL);
    ::waitpid(process, &status, 0);
    return stop == Stop::kTooLong ? std::optional(status) : std::nullopt;
  }
}

Measurer::Stop Measurer::must_stop(const Wish& wish, int measured, ResultRequest::Time& rested) {
  const auto now = ResultRequest::Time::clock::now();
  const std::lock_guard lock(mutex_);
  if (stopping_ || (wish.was_left && is_due())) return Stop::kForOthers;
  const bool is_over = wish_.flight != wish.flight || wish_.landed;
  if (!is_over && wish_.photos <= measured) rested = now;
  return now > rested + options_.longest ? Stop::kTooLong : Stop::kNo;
}

}  // namespace plumbline::service
