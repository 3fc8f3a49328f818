// SPDX-License-Identifier: MIT
// A process that this one starts, with pipes to its stdin and from its stdout. POSIX.
#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace tribo::app {

class ChildProcess {
  public:
    ChildProcess() = default;
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    // Ends the process with SIGTERM, and waits.
    ~ChildProcess();

    // Starts `arguments[0]`, searched in PATH unless it has a slash. `joined`: stderr goes the way of stdout.
    // Returns 0 or the error number.
    int start(const std::string& program, std::vector<std::string> arguments, bool joined = false);

    int output() const { return output_; }  // descriptor of its stdout
    // Writes all bytes to its stdin. A process that is gone does not read them; its end is seen elsewhere.
    void write(std::string_view bytes) const;
    // Appends what it has written. Waits for some bytes; false at the end of its stdout.
    bool read(std::string& bytes) const;
    // Closes its stdin and waits for its end. Returns the status of waitpid(2).
    int wait();
    void signal(int number) const;

  private:
    void close_input();

    pid_t pid_ = 0;
    int input_ = -1, output_ = -1;
};

}  // namespace tribo::app
