// SPDX-License-Identifier: MIT
// A folder of results that appears complete or not at all. It is built in a hidden sibling and moved into
// place by one rename. However a run ends, there is the old folder, the new one, or none.
#pragma once

#include <string>
#include <vector>

#include "files/files.hpp"

namespace tribo::files {

// The file that marks a folder as Tribo's, and the start of its "schema" value.
struct FolderMark {
    std::string file = "summary.json";
    std::string schema = "tribo.";
};

// The claim of one run on DIR. During its life the files are written to `.NAME.tribo-partial-PID-N` beside
// DIR. Another run with the same DIR has its own sibling, and the last commit wins. A sibling is locked
// (flock) while its run lives, so that a later run can identify and remove the folders of killed runs.
class OutputFolder {
  public:
    // Refuses a DIR that is a file, a link, or a non-empty folder without the mark of Tribo. Creates missing
    // parents; they are removed again without a commit.
    static FileResult<OutputFolder> open(const std::string& dir, FolderMark mark = {});
    OutputFolder(OutputFolder&& other) noexcept;
    OutputFolder& operator=(OutputFolder&&) = delete;
    // Without a commit removes everything.
    ~OutputFolder();

    // Returns the current path for a file called `name`.
    std::string file(const std::string& name) const { return partial_ + "/" + name; }
    // The folder as named by the user.
    const std::string& name() const { return shown_; }
    // The present or future path of DIR: absolute, with resolved links in its parents.
    const std::string& path() const { return target_; }

    // Syncs every file to the disk and moves the folder to DIR. An older folder is removed completely.
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
