// SPDX-License-Identifier: MIT
// The tools of a program from its comments, messages and names of tools. A text with a number is about that
// tool; a text without one is about the tool that is changed next, or that was just changed. Any thread;
// allocates.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "motion/path/program.hpp"
#include "readers/tools/declared_tool.hpp"
#include "readers/tools/tool_text.hpp"

namespace tribo::readers {

// Returns the sizes in mm. What an angle means depends on the shape: the full angle of a point; of the side
// to the axis for tapered and dovetail mills, and for chamfer mills up to 45 degrees or behind TAPER.
ToolSizes sizes_of(const ToolText& text, double unit_of_program_mm);

class ToolNotes {
  public:
    // Larger numbers in texts are those of a tool library: they name no tool of the program.
    void number_up_to(int largest) { largest_number_ = largest; }
    // Reads a comment, a message or the name of a tool; each line once, though a loop may run it again.
    // `is_beside_change`: it stands in the block that changes the tool, and so names it. `called_tool`: the
    // block only calls this tool, for a change that comes; a size in it is that tool's.
    void read(std::string_view text, int line, bool is_beside_change = false,
              std::optional<int> called_tool = std::nullopt);
    // Reads the name under which a program calls tool `number`: a text about that name describes it, else the
    // name itself.
    void name(int number, std::string_view name, int line);
    // Returns the number of the text that holds this name: T2 = MILL_D10.
    std::optional<int> number_of(std::string_view name) const;
    bool has(int number) const { return index_.contains(number); }
    // Returns the line of the text about the tool; 0: none.
    int line_of(int tool) const;
    // Another tool comes into the spindle; maybe under the number of the one before.
    void change(int tool);
    // The tool in the spindle moves at feed: what is written from now on is about the next one. Says also
    // whether it does more than go up and down along its axis, as a drill does.
    void cut(const motion::Move& move);

    // Returns the diameter for radius compensation, mm; none if no text states it, or if the text says that
    // the control corrects wear alone.
    std::optional<double> diameter_mm(int tool, double unit_of_program_mm) const;
    // Says why diameter_mm() has none: "nothing states the diameter of tool 2"; or the `radius`.
    std::string no_diameter_text(int tool, const char* size = "diameter") const;
    // Returns a comment that states the tool's diameter for compensation: "(T2 D=50)". Its size is that of
    // the text about the tool, else 10 of the unit of the program.
    std::string diameter_comment(int tool) const;
    // Returns the diameter that a text states for the tool, mm; none if no text does.
    std::optional<double> stated_diameter_mm(int tool, double unit_of_program_mm) const;

    // Returns the tools in the order of their texts. Adds warnings where two texts disagree about one number.
    std::vector<motion::DeclaredTool> tools(double unit_of_program_mm, const std::string& source,
                                            Warnings& warnings) const;

  private:
    struct Note {
        ToolText text;
        int line = 0;
    };
    struct Conflict {
        int tool = 0;
        Note first, second;
    };
    bool take(std::string_view text, int line, bool is_name, std::optional<int> called_tool);
    bool take_of_library(const Note& note);
    void put_library_texts();
    void attach(int tool, const Note& note);
    bool keep_names(std::string_view text, const Note& note);
    const Note* find(int tool) const;

    // Most different tools of a program (job/program_tools.hpp refuses more), and most conflicts.
    static constexpr std::size_t kMostTools = 1000, kMostConflicts = 100;

    std::vector<std::pair<int, Note>> notes_;                    // one for each number
    std::map<int, std::size_t> index_;                           // of a number in notes_
    std::map<std::string, Note, std::less<>> named_;             // by the name in quotes, folded
    std::vector<std::pair<int, std::string>> texts_of_numbers_;  // folded
    std::vector<Conflict> conflicts_;
    std::vector<bool> lines_;  // that were read
    int line_ = -1;            // the last one
    bool is_read_ = false;     // it was read before, in a loop
    bool is_taken_ = false;    // for a text about a tool
    // Texts with the number of a library that no tool was changed for so far.
    std::vector<Note> of_library_;
    struct Use {
        bool drills = false, mills = false;
    };
    std::map<int, Use> uses_;
    std::optional<int> largest_number_;
    std::optional<Note> pending_;     // about the next tool
    int list_line_ = -2;              // the last line of a list of tools without numbers
    std::optional<int> window_tool_;  // changed and has not cut yet
    bool window_has_note_ = false;
    bool is_empty_ = false;  // T0 is in the spindle: a tool of that number, if it cuts, else none
    bool has_changed_ = false;
    bool empties_ = false;       // T0 has put away a tool
    int cuts_empty_line_ = 0;    // of the first feed move after that; 0: none
    bool expects_size_ = false;  // "Tool Size" stood before
};

}  // namespace tribo::readers
