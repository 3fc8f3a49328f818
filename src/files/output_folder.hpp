// SPDX-License-Identifier: MIT
// A folder of results that appears complete or not at all. It is built in a hidden sibling and moved into
// place by one rename. However a run ends, there is the old folder, the new one, or none.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "files/files.hpp"

namespace tribo::files {

// Each such folder lists the files of its run in `.tribo-files`. A later run into the same folder removes
// those alone; all others stay. While an object lives, `.NAME.tribo-partial-RANDOM` beside DIR takes the
// files; another run with the same DIR has a sibling of its own, and the last to commit wins. A sibling is
// locked (flock) while its run lives, so that a later run can tell what a killed one left and remove it.
class OutputFolder {
  public:
    // True for the files that the run may write, by their names relative to DIR.
    using Writes = std::function<bool(const std::string& name)>;

    // Refuses a DIR that is a file or a link, a folder that holds something and no list of a run, and one
    // where a file that the run may write is not of that list. Missing parents are made, and removed again
    // without a commit.
    static FileResult<OutputFolder> open(const std::string& dir, const Writes& writes);
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

    // Sends every file to the disk and puts the folder in the place of DIR. The files of the older run
    // disappear together; the other files of DIR are in the new folder.
    FileResult<void> commit();

  private:
    OutputFolder() = default;
    FileResult<void> make_partial(const std::string& parent, const std::string& base);
    FileResult<void> replace_target();
    void forget();

    std::string shown_, target_, partial_;
    std::vector<std::string> made_parents_;  // outermost first
    int lock_ = -1;                          // descriptor of the partial folder
};

}  // namespace tribo::files
