// SPDX-License-Identifier: MIT
// Clocks, medians and the list of what was measured.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace tribo::bench {

// Seconds of the wall clock, and of the processor by the calling thread: on a machine that others use too,
// the second is what the work itself took.
double wall_s();
double thread_s();

// Seconds of the processor for reading or writing a megabyte that is in no cache.
double memory_s_per_mb();

// Makes the compiler believe that `value` is used.
template <class T>
void keep(const T& value) {
    asm volatile("" : : "g"(&value) : "memory");
}

double median(std::vector<double> values);

// The median over `repeats` calls of `once`, which gives what it measured.
template <class Once>
double median_of(int repeats, Once once) {
    std::vector<double> values;
    for (int n = 0; n < repeats; ++n) values.push_back(once());
    return median(std::move(values));
}

enum class Better { lower, higher };

struct Entry {
    std::string name;
    double value = 0;
    std::string unit;
    std::optional<double> goal{};  // in the same unit
    Better better = Better::lower;
    std::string peer{};  // who else did the same work
    std::optional<double> peer_value{};

    // How many times better than the peer: above 1 is ahead of it.
    std::optional<double> ratio() const;
    bool met() const;
};

// Prints each entry as it comes, a line each.
class Report {
  public:
    void section(const std::string& title);
    void note(const std::string& text);
    void add(Entry entry);

    const std::vector<Entry>& entries() const { return entries_; }
    // [{"name","value","unit","goal","peer","peer_value","ratio"}], what is not known left out.
    std::string json() const;

  private:
    std::vector<Entry> entries_;
};

// The measurements, a file each.
void measure_processes(Report& report, int repeats);  // first: see the function
void measure_long_programs(Report& report);           // the same
void measure_forces(Report& report, int repeats);
void measure_stability(Report& report, int repeats);
void measure_queries(Report& report);
void measure_contact(Report& report);
void measure_rows(Report& report);
void measure_carving(Report& report, int repeats);
void measure_many_moves(Report& report, int repeats);
void measure_milling(Report& report, int repeats);
void measure_sessions(Report& report, int repeats);
void measure_scrub(Report& report);
void measure_noise(Report& report, int repeats);
void measure_sound(Report& report);
void measure_elastic(Report& report);
void measure_servo(Report& report);
void measure_live(Report& report);
void measure_live_servo(Report& report);  // by measure_live

}  // namespace tribo::bench
