// SPDX-License-Identifier: MIT
// The verbs of the program, one file each. A function adds the verb to the command line; when the verb runs,
// it stores the exit code.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace tribo::app {

void add_render(CLI::App& program, int& exit_code);
void add_read_sofa(CLI::App& program, int& exit_code);
void add_live(CLI::App& program, int& exit_code);
void add_inspect(CLI::App& program, int& exit_code);
void add_learn(CLI::App& program, int& exit_code);
void add_rub(CLI::App& program, int& exit_code);
void add_feel(CLI::App& program, int& exit_code);
void add_press(CLI::App& program, int& exit_code);
void add_site(CLI::App& program, int& exit_code);
void add_feed(CLI::App& program, int& exit_code);
void add_stability(CLI::App& program, int& exit_code);
void add_audit(CLI::App& program, int& exit_code);
void add_compare(CLI::App& program, int& exit_code);
void add_sweep(CLI::App& program, int& exit_code);
void add_sweep_worker(CLI::App& program, int& exit_code);
void add_devices(CLI::App& program, int& exit_code);

}  // namespace tribo::app
