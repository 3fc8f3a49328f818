// SPDX-License-Identifier: MIT
#include "readers/gcode/codes.hpp"

namespace tribo::readers::gcode {
namespace {

constexpr std::string_view kPlainMoves = "let the CAM system write it as plain G0 to G3 moves";
constexpr std::string_view kApt =
    "give the machine-independent path instead: APT CLDATA or keyframes with tool axes";

}  // namespace

std::optional<GGroup> group_of_g(int tenths) {
    switch (tenths) {
        case 40:
        case 100:
        case 280:
        case 300:
        case 520:
        case 530:
        case 920:
        case 921:
        case 922:
        case 923:
            return GGroup::non_modal;
        case 650:
        case 660:
            return GGroup::macro_call;
        case 310:
        case 382:
        case 383:
        case 384:
        case 385:
            return GGroup::probing;
        case 0:
        case 10:
        case 20:
        case 30:
        case 50:
        case 51:
        case 52:
        case 53:
        case 62:
        case 730:
        case 740:
        case 760:
        case 810:
        case 820:
        case 830:
        case 840:
        case 850:
        case 860:
        case 870:
        case 880:
        case 890:
            return GGroup::motion;
        case 800:
            return GGroup::cycle_end;
        case 170:
        case 180:
        case 190:
            return GGroup::plane;
        case 900:
        case 910:
            return GGroup::distance;
        case 901:
        case 911:
            return GGroup::arc_distance;
        case 930:
        case 940:
        case 950:
            return GGroup::feed_mode;
        case 200:
        case 210:
        case 700:
        case 710:
            return GGroup::units;
        case 400:
        case 410:
        case 411:
        case 412:
        case 413:
        case 414:
        case 415:
        case 416:
        case 420:
        case 421:
        case 422:
        case 423:
        case 424:
        case 425:
        case 426:
            return GGroup::cutter_side;
        case 430:
        case 431:
        case 432:
        case 434:
        case 435:
        case 440:
        case 490:
        case 1680:
        case 1690:
        case 2340:
            return GGroup::tool_length;
        case 980:
        case 990:
            return GGroup::return_level;
        case 540:
        case 541:
        case 550:
        case 560:
        case 570:
        case 580:
        case 590:
        case 591:
        case 592:
        case 593:
        case 1540:
            return GGroup::work_offset;
        case 610:
        case 611:
        case 620:
        case 630:
        case 640:
            return GGroup::path_control;
        case 720:
            return GGroup::hole_pattern;
        case 970:
            return GGroup::spindle_mode;
        case 150:
        case 160:
            return GGroup::polar;
        case 500:
        case 510:
            return GGroup::scaling;
        case 501:
        case 511:
        case 1000:  // Haas
        case 1010:
            return GGroup::mirror;
        case 680:
        case 682:
        case 683:
        case 690:
        case 691:
        case 2680:
        case 2690:
            return GGroup::rotation;
        case 360:
        case 390:
            return GGroup::corner;
        case 71:
        case 1070:
            return GGroup::cylinder;
        case 120:
        case 130:
            return GGroup::round_pocket;
        case 331:
            return GGroup::rigid_tap;
        case 531:
        case 536:
        case 2530:  // Haas
            return GGroup::tool_to_plane;
        case 542:
        case 2540:  // Haas
        case 2550:
            return GGroup::turning_zero;
        case 80:   // look-ahead, with P
        case 90:   // exact stop of one block
        case 110:  // end of data input
        case 131:  // polar interpolation off
        case 151:  // polar coordinates off
        case 220:  // stored stroke limits
        case 230:
        case 250:  // spindle speed fluctuation
        case 260:
        case 281:  // setting the home position
        case 301:
        case 401:   // normal direction control off
        case 502:   // polygon turning off
        case 1500:  // normal direction control off, without words
        case 1510:  // normal direction control: turns the tool about its own axis
        case 1520:
        case 670:   // modal macro off
        case 1030:  // limit of look-ahead (Haas)
        case 1130:  // polar interpolation off
        case 1870:  // smoothness (Haas)
        case 470:   // text that the control engraves (Haas)
        case 544:   // workpiece setting errors
            return GGroup::idle;
        default:
            if (tenths >= 1100 && tenths <= 1290 && tenths % 10 == 0) return GGroup::work_offset;
            return std::nullopt;
    }
}

std::optional<MGroup> group_of_m(int tenths) {
    switch (tenths) {
        case 0:
        case 10:
        case 20:
        case 300:
        case 600:
            return MGroup::stop;
        case 60:
            return MGroup::tool;
        case 30:
        case 40:
        case 50:
        case 130:
        case 140:
            return MGroup::spindle;
        case 70:
        case 80:
        case 90:
            return MGroup::coolant;
        case 480:
        case 490:
        case 500:
        case 510:
        case 520:
        case 530:
            return MGroup::overrides;
        case 190:
            return MGroup::orientation;
        case 700:
        case 710:
        case 720:
            return MGroup::saved_modes;
        case 620:
        case 630:
        case 640:
        case 650:
        case 670:
        case 680:
            return MGroup::outputs;
        case 970:
        case 980:
        case 990:
        case 1980:
            return MGroup::subprogram;
        case 1280:
        case 1290:
        case 4280:
        case 4290:
        case 4300:
            return MGroup::tool_tip;
        default:
            return std::nullopt;
    }
}

Unread unread_g(int tenths) {
    switch (tenths) {
        case 60:
        case 61:
            return {"splines of this kind", kPlainMoves};
        case 70:
            return {"lathe diameters", "give a milling program"};
        case 171:
        case 181:
        case 191:
            return {"planes of the axes U V W", kPlainMoves};
        case 121:
        case 1120:
            return {"polar interpolation", kPlainMoves};
        case 320:
        case 330:
            return {"moves synchronised with the spindle", kPlainMoves};
        case 450:
        case 460:
        case 480:
            return {"moves longer or shorter by an offset", kPlainMoves};
        case 661:
            return {"macro calls at every block", "let the control or the CAM system write the macro out"};
        case 161:
            return {"polar coordinates in space", kPlainMoves};
        case 681:
        case 684:
            return {"tilted or turned planes", kApt};
        case 960:
            return {"constant surface speed", "use G97 with S in turns per minute"};
        default:
            return {"", "check the number and the dialect; a shop may let it call a macro (O9010 to O9019)"};
    }
}

Unread unread_m(int tenths) {
    switch (tenths) {
        case 730:
            return {"restoring the modes that M70 has saved", "write the modes out"};
        default:
            return {"", ""};
    }
}

}  // namespace tribo::readers::gcode
