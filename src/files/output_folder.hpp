// SPDX-License-Identifier: MIT
// A folder of results that appears whole or not at all. It is built in a hidden sibling and takes its place
// by one rename; whatever way a run ends, there is the old folder, the new one, or none.
#pragma once

#include <string>
#include <vector>

#include "files/files.hpp"

namespace tribo::files {

// The file by which Tribo knows a folder as its own, and how the value of that file's "schema" begins.
struct FolderMark {
    std::string file = "summary.json";
    std::string schema = "tribo.";
};

// One run's hold on DIR. While it lives, `.NAME.tribo-partial-PID-N` beside DIR takes the files; another run
// with the same DIR has a sibling of its own, and the last to commit wins. A sibling is locked (flock) while
// its run lives, so that a later run can tell what a killed one left and remove it.
class OutputFolder {
  public:
    // Refuses a DIR that is a file, a link, or a folder that holds something and is not marked as Tribo's.
    // Missing parents are made, and removed again if nothing comes of it.
    static FileResult<OutputFolder> open(const std::string& dir, FolderMark mark = {});
    OutputFolder(OutputFolder&& other) noexcept;
    OutputFolder& operator=(OutputFolder&&) = delete;
    // Without a commit nothing is left.
    ~OutputFolder();

    // Where a file called `name` is to be written now.
    std::string file(const std::string& name) const { return partial_ + "/" + name; }
    // The folder as the user named it.
    const std::string& name() const { return shown_; }
    // Where DIR is or will be: absolute, links in its parents resolved.
    const std::string& path() const { return target_; }

    // Sends every file to the disk and puts the folder in the place of DIR; an older one disappears whole.
    FileResult<void> commit();

  private:
    OutputFolder() = default;
    FileResult<void> make_partial(const std::string& parent, const std::string& base);

    std::string shown_, target_, partial_;
    FolderMark mark_;
    std::vector<std::string> made_parents_;  // outermost first
    int lock_ = -1;                          // descriptor of the partial folder
};

}  // namespace tribo::files
