// SPDX-License-Identifier: MIT
// `tribo press M.json --stroke CSV --out DIR`: the flags.
#include "app/touch/press.hpp"

#include <memory>
#include <string>

#include "app/options.hpp"
#include "app/verbs/verbs.hpp"
#include "elastic/sheet.hpp"
#include "tribo/threads.hpp"

namespace tribo::app {

void add_press(CLI::App& program, int& exit_code) {
    const auto call = std::make_shared<PressCall>();
    const auto contact = std::make_shared<std::string>("area");
    CLI::App* verb = program.add_subcommand("press", "Press a material's image: a picture for every frame");
    verb->add_option("MATERIAL", call->material, "Material file (JSON)")->required();
    verb->add_option("--stroke", call->stroke, "Stroke of a finger: t_s,x_mm,y_mm,force_n")
        ->required()
        ->type_name("CSV");
    verb->add_option("--out", call->out, "Folder for the frames; an older one of Tribo's is replaced whole")
        ->required()
        ->type_name("DIR");
    verb->add_option("--size", call->size_px, "Side of the square frames; 512 if absent")
        ->check(CLI::Range(1, elastic::kMostNodesPerSide))
        ->type_name("PX");
    verb->add_option("--radius-mm", call->radius_mm, "Radius of the contact; 6 if absent")
        ->check(within(kLimits.contact_radius))
        ->type_name("R");
    verb->add_option("--fps", call->fps, "Frames a second; 60 if absent")
        ->check(within(kLimits.frame_rate))
        ->type_name("HZ");
    verb->add_option("--contact", *contact, "area: the whole contact presses; point: its centre alone")
        ->check(CLI::IsMember({"area", "point"}));
    verb->add_flag("--heights", call->heights,
                   "Write the displacement of every frame, too: frame_0000.f32, float32, mm");
    verb->add_flag("--as-published", call->as_published,
                   "The paper's equations 1 to 3 as printed: pressed by time, whatever the force");
    verb->add_option("--threads", call->threads, "Threads to use; all processors if absent")
        ->check(CLI::Range(1, kMaxThreads))
        ->type_name("N");
    verb->callback([call, contact, &exit_code] {
        call->contact = *contact == "point" ? elastic::ContactShape::point : elastic::ContactShape::area;
        exit_code = press(*call);
    });
}

}  // namespace tribo::app
