// SPDX-License-Identifier: MIT
#include "firmware/service/measurer.h"

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
    : options_(options), events_(std::move(events)), thread_([this] { run(); }) {}

Measurer::~Measurer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void Measurer::stored(const std::string& flight) {
  const std::lock_guard lock(mutex_);
  if (flight != wish_.flight) wish_ = {flight, 0, false};
  ++wish_.photos;
}

void Measurer::ended(const std::string& flight) {
  const std::lock_guard lock(mutex_);
  if (flight == wish_.flight) wish_.landed = true;
}

void Measurer::run() {
  for (;;) {
    Wish wish;
    bool again = false;
    {
      const std::lock_guard lock(mutex_);
      if (stopping_) return;
      wish = wish_;
      again = failed_ && wish.landed;
    }
    const bool news = wish.photos > measured_photos_ || wish.flight != measured_flight_;
    if (wish.photos >= options_.first_at && (news || again)) {
      measure(wish);
    } else {
      std::this_thread::sleep_for(100ms);
    }
  }
}

void Measurer::measure(const Wish& wish) {
  const std::string folder = options_.flights + "/" + wish.flight;
  measured_flight_ = wish.flight;
  measured_photos_ = wish.photos;
  if (!options_.request_file.empty()) {
    if (!request(folder)) events_.failed("Cannot write " + options_.request_file + ".");
    return;
  }
  const pid_t process = spawn(folder);
  const int status = process > 0 ? wait_for(process, folder) : -1;
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) return;
    if (wish_.flight == wish.flight) measured_photos_ = wish_.photos;  // it followed them
  }
  judge(folder, status, wish.landed);
}

void Measurer::judge(const std::string& folder, int status, bool was_last_try) {
  const bool good = status >= 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  failed_ = !good && !was_last_try;
  if (good) return;
  if (status >= 0 && WIFSIGNALED(status)) {
    events_.failed("The measuring process was ended by signal " + std::to_string(WTERMSIG(status)) +
                   "; the photos are kept.");
  } else {
    events_.failed("The measuring process failed; the photos are kept, and " + folder + kLog +
                   " says why.");
  }
}

bool Measurer::request(const std::string& flight) const {
  std::ofstream file(options_.request_file, std::ios::trunc);
  file << flight << '\n';
  file.close();
  return file.good();
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

int Measurer::wait_for(pid_t process, const std::string& flight) {
  ResultLines results(flight + kLog);
  auto rested = std::chrono::steady_clock::now();  // when nothing was due last, or a result came
  int measured = 0;
  int status = 0;
  for (;;) {
    const auto now = std::chrono::steady_clock::now();
    const bool is_over = ::waitpid(process, &status, WNOHANG) == process;
    while (const auto sentence = results.next()) {
      measured = photos_of(*sentence);
      rested = now;
      events_.measured({*sentence, read_result(flight + kResultFolder)});
    }
    if (is_over) return status;
    bool stop = false;
    {
      const std::lock_guard lock(mutex_);
      const bool is_due = wish_.photos > measured || wish_.landed;
      if (!is_due) rested = now;
      stop = stopping_ || now > rested + options_.longest;
    }
    if (stop) {
      ::kill(process, SIGKILL);
      ::waitpid(process, &status, 0);
      return status;
    }
    std::this_thread::sleep_for(50ms);
  }
}

}  // namespace plumbline::service
