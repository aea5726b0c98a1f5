// SPDX-License-Identifier: MIT
#include "firmware/commands/run_report.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "firmware/deliver/deliver.h"
#include "firmware/deliver/paper_stages.h"
#include "firmware/deliver/table.h"

namespace plumbline::commands {
namespace {

std::size_t peak_memory_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in kB
}

}  // namespace

RunReport::RunReport() : terminal_(isatty(STDERR_FILENO) == 1), stage_began_(Clock::now()) {}

RunReport::~RunReport() { clear_line(); }

Progress RunReport::progress() {
  return [this](const std::string& stage, int done, int total) { show(stage, done, total); };
}

void RunReport::show(const std::string& stage, int done, int total) {
  if (stage != stage_) {
    end_stage();
    stage_ = stage;
  }
  if (!terminal_) return;
  const std::chrono::duration<double> gone = Clock::now() - stage_began_;
  std::fprintf(stderr, "\r\033[K%s %d/%d  %.0f s", stage.c_str(), done, total, gone.count());
  if (done > 0 && done < total) {
    std::fprintf(stderr, ", about %.0f s left", gone.count() * (total - done) / done);
  }
  std::fflush(stderr);
}

void RunReport::clear_line() {
  if (terminal_ && !stage_.empty()) std::fputs("\r\033[K", stderr);
}

void RunReport::end_stage() {
  const auto now = Clock::now();
  if (!stage_.empty()) {
    timing_.stages_s.emplace_back(stage_,
                                  std::chrono::duration<double>(now - stage_began_).count());
  }
  stage_began_ = now;
}

deliver::Timing RunReport::timing() {
  end_stage();
  clear_line();
  stage_.clear();
  timing_.peak_memory_bytes = peak_memory_bytes();
  return timing_;
}

int fail(const Error& error) {
  std::cerr << "plumbline: " << error.sentence << '\n';
  return kWorkFailed;
}

int deliver_result(const deliver::Product& product, RunReport& report,
                   const std::filesystem::path& folder, bool json) {
  if (auto written = deliver::write(product, report.timing(), folder); !written) {
    return fail(written.error());
  }
  if (json) {
    std::cout << deliver::summary_json(product);
  } else {
    std::cout << deliver::paper_stages_text(product) << deliver::accuracy_table(product)
              << "Report: " << (folder / "report.html").string() << '\n';
  }
  if (product.solution.summary.converged) return kGood;
  return fail({"The adjustment did not converge: there is no solution. " + folder.string() +
               " shows how far it came; residuals and warnings there tell what to look at."});
}

}  // namespace plumbline::commands
