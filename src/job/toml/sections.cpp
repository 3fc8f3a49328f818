// SPDX-License-Identifier: MIT
#include "job/toml/sections.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "milling/tool/materials.hpp"
#include "sound/cut/machine.hpp"
#include "sound/place/room.hpp"

namespace tribo::job {
namespace {

using namespace std::string_view_literals;

constexpr std::array kPartKeys{"surface"sv, "unit_mm"sv};
constexpr std::array kCoefficientKeys{"ktc_n_per_mm2"sv, "krc_n_per_mm2"sv, "kac_n_per_mm2"sv,
                                      "kte_n_per_mm"sv,  "kre_n_per_mm"sv,  "kae_n_per_mm"sv};
// Of kCoefficientKeys.
constexpr std::array kCoefficientLimits{kLimits.ktc, kLimits.krc, kLimits.krc,
                                        kLimits.kte, kLimits.kre, kLimits.kre};
constexpr std::array kMaterialKeys{"name"sv,         "ktc_n_per_mm2"sv, "krc_n_per_mm2"sv, "kac_n_per_mm2"sv,
                                   "kte_n_per_mm"sv, "kre_n_per_mm"sv,  "kae_n_per_mm"sv,  "spread"sv};
constexpr std::array kProcessKeys{"spindle_rpm"sv, "feed_mm_per_min"sv, "spindle_variation"sv,
                                  "spindle_variation_hz"sv};
constexpr std::array kPathKeys{"keyframes"sv, "gcode"sv,   "apt"sv,     "interpolation"sv,
                               "machine"sv,   "unit_mm"sv, "dialect"sv, "tools"sv};
// In the order of kPathKindWords.
constexpr std::array kPathKinds{PathKind::keyframes, PathKind::gcode, PathKind::apt};
constexpr std::array kInterpolationWords{"spline"sv, "linear"sv, "fit"sv};
constexpr std::array kModeKeys{
    "direction"sv, "frequency_hz"sv,     "damping_ratio"sv,  "stiffness_n_per_mm"sv,
    "on"sv,        "frequency_spread"sv, "damping_spread"sv, "stiffness_spread"sv};
constexpr std::array kDynamicsKeys{"estimate"sv};
constexpr std::array kEngagementKeys{"entry_deg"sv, "exit_deg"sv, "axial_depth_mm"sv};
constexpr std::array kSoundKeys{"listener_mm"sv,
                                "distance_factor"sv,
                                "reference_distance_m"sv,
                                "gain_db"sv,
                                "bits"sv,
                                "hrtf"sv,
                                "mode"sv,
                                "recording"sv,
                                "recording_rpm"sv,
                                "recording_share"sv,
                                "idle_recording"sv,
                                "chips"sv,
                                "idle_recording_rpm"sv,
                                "equalize"sv,
                                "machine"sv,
                                "room"sv,
                                "cut_db"sv,
                                "spindle_db"sv,
                                "chips_db"sv,
                                "room_db"sv};
constexpr std::array kSoundModes{"hrtf"sv, "sphere"sv, "pan"sv};
constexpr std::array kEqualizations{"diffuse"sv, "none"sv};
constexpr std::array kHapticsKeys{"force_scale"sv,     "profile"sv,          "probe"sv,
                                  "friction_static"sv, "friction_kinetic"sv, "stiffness_n_per_mm"sv};
constexpr std::array kProbeWords{"point"sv, "ray"sv, "cylinder"sv};

}  // namespace

readers::ModelFile read_part(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[part]", kPartKeys);
    return {section.required_path("surface"), read_unit_mm(section)};
}

JobMaterial read_material(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[material]", kMaterialKeys);
    JobMaterial material;
    std::string_view present;
    for (const std::string_view key : kCoefficientKeys) {
        if (present.empty() && section.has(key)) present = key;
    }
    if (section.has("name") && !present.empty()) {
        section.fail(present, "[material] has both a name and coefficients of its own",
                     "keep the name or the six coefficients");
    } else if (section.has("name")) {
        material.name = section.text("name").value_or("");
        const Result<milling::WorkpieceMaterial> known = milling::find_material(material.name);
        if (!known) section.fail("name", known.error().cause, known.error().remedy);
        if (section.has("spread"))
            section.fail("spread",
                         "'spread' belongs to coefficients of your own: a named material has its band",
                         "remove it, or give the six coefficients");
    } else if (!present.empty()) {
        milling::CuttingCoefficients k;
        double* const values[] = {&k.ktc, &k.krc, &k.kac, &k.kte, &k.kre, &k.kae};
        for (std::size_t i = 0; i < kCoefficientKeys.size(); ++i) {
            *values[i] = section.required_number(kCoefficientKeys[i], kCoefficientLimits[i]);
        }
        material.coefficients = k;
        material.spread = section.number("spread", kLimits.spread).value_or(0);
    } else {
        section.fail("", "[material] has no name and no coefficients",
                     "write name = \"al7075-t6\" or ktc_n_per_mm2, krc_, kac_, kte_n_per_mm, kre_ and kae_");
    }
    return material;
}

JobProcess read_process(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[process]", kProcessKeys);
    JobProcess process;
    process.spindle_rpm = section.number("spindle_rpm", kLimits.spindle_speed).value_or(0);
    process.feed_mm_per_min = section.number("feed_mm_per_min", kLimits.feed).value_or(0);
    process.spindle_variation = section.number("spindle_variation", kLimits.spindle_variation).value_or(0);
    process.spindle_variation_hz =
        section.number("spindle_variation_hz", kLimits.spindle_variation_rate).value_or(0);
    for (const auto& [given, missing] : {std::pair{"spindle_variation", "spindle_variation_hz"},
                                         std::pair{"spindle_variation_hz", "spindle_variation"}}) {
        if (section.has(given) && !section.has(missing))
            section.fail(
                given, "'" + std::string(given) + "' stands without '" + missing + "'",
                "give both: by which share of its speed the spindle swings, and how often per second");
    }
    return process;
}

JobPath read_path(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[path]", kPathKeys);
    JobPath path;
    std::string_view kind;
    for (std::size_t n = 0; n < kPathKindWords.size(); ++n) {
        const std::string_view key = kPathKindWords[n];
        if (!section.has(key)) continue;
        if (!kind.empty()) {
            section.fail(key, "[path] has both '" + std::string(kind) + "' and '" + std::string(key) + "'",
                         "keep one of them");
            return path;
        }
        kind = key;
        path.kind = kPathKinds[n];
        path.file = section.required_path(kind);
    }
    if (kind.empty()) {
        section.fail("", "[path] names no program",
                     "write keyframes = \"F.csv\", gcode = \"F.ngc\" or apt = \"F.apt\"");
    }
    if (path.kind != PathKind::keyframes && section.has("interpolation")) {
        section.fail("interpolation", "'interpolation' belongs to keyframes",
                     "remove it: the program says it itself");
    }
    if (path.kind == PathKind::gcode && section.has("unit_mm")) {
        section.fail("unit_mm", "'unit_mm' belongs to keyframes and APT",
                     "remove it: the program says it itself");
    }
    if (path.kind != PathKind::gcode && section.has("machine")) {
        section.fail("machine", "'machine' belongs to G-code: other paths hold the tool's axis already",
                     "remove it");
    }
    if (path.kind == PathKind::keyframes && section.has("tools")) {
        section.fail("tools", "'tools' belongs to a program: keyframes call no tool",
                     "describe it as [cutter]");
    }
    path.tools = section.path("tools").value_or("");
    if (path.kind != PathKind::gcode && section.has("dialect")) {
        section.fail("dialect", "'dialect' belongs to G-code", "remove it");
    }
    if (const auto dialect = section.word("dialect", readers::kDialectWords)) {
        path.dialect = static_cast<readers::Dialect>(*dialect);
    }
    path.interpolation =
        static_cast<motion::Interpolation>(section.word("interpolation", kInterpolationWords).value_or(0));
    path.machine = section.text("machine").value_or("");
    if (is_machine_file(path.machine)) {
        path.machine = file.beside(path.machine, "machine", table.get("machine")->source());
    } else if (!path.machine.empty()) {
        const Result<motion::Machine> known = motion::named_machine(path.machine);
        if (!known) section.fail("machine", known.error().cause, known.error().remedy);
    }
    path.unit_mm = read_unit_mm(section).value_or(1);
    if (path.kind == PathKind::apt && path.unit_mm != 1 && path.unit_mm != 25.4)
        section.fail("unit_mm", "the points of APT are millimetres or inches", "write 1 or 25.4");
    return path;
}

JobEngagement read_engagement(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[engagement]", kEngagementKeys);
    JobEngagement engagement;
    engagement.entry_deg = section.required_number("entry_deg", kLimits.engagement_angle);
    engagement.exit_deg = section.required_number("exit_deg", kLimits.engagement_angle);
    engagement.axial_depth_mm = section.required_number("axial_depth_mm", kLimits.axial_depth);
    if (engagement.exit_deg <= engagement.entry_deg) {
        section.fail("exit_deg", "'exit_deg' is not behind 'entry_deg'",
                     "angles run clockwise from the left of the feed: up-milling starts at 0, down-milling "
                     "ends at 180");
    }
    return engagement;
}

dynamics::Mode read_mode(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[[mode]]", kModeKeys);
    dynamics::Mode mode;
    if (!section.has("direction")) section.missing("direction");
    mode.direction = read_direction(section, "direction", mode.direction);
    mode.frequency_hz = section.required_number("frequency_hz", kLimits.mode_frequency);
    mode.damping_ratio = section.required_number("damping_ratio", kLimits.mode_damping);
    mode.stiffness_n_per_mm = section.required_number("stiffness_n_per_mm", kLimits.mode_stiffness);
    if (section.word("on", kModeOnWords).value_or(0) == 1) mode.on = dynamics::ModeOn::part;
    const auto spread = [&](std::string_view key) { return section.number(key, kLimits.spread).value_or(0); };
    mode.spread = {spread("frequency_spread"), spread("damping_spread"), spread("stiffness_spread")};
    return mode;
}

std::optional<JobEstimate> read_dynamics(TomlSection& root, const toml::table& table, const Job& job) {
    TomlSection section(root.file(), table, "[dynamics]", kDynamicsKeys);
    if (!section.flag("estimate").value_or(false)) return std::nullopt;
    const auto on_tool = [](const auto& m) { return m.on == dynamics::ModeOn::tool; };
    if (std::ranges::any_of(job.modes, on_tool) || std::ranges::any_of(job.frfs, on_tool))
        section.fail(
            "estimate", "the job has modes of the tool, and asks to estimate them",
            "remove 'estimate' or each [[mode]] and [[frf]] of the tool; those on = \"part\" may stay");
    const std::vector<const toml::table*> cutters = root.tables("cutter");
    for (std::size_t n = 0; n < std::min(cutters.size(), job.cutters.size()); ++n) {
        if (job.cutters[n].stickout_mm > 0) continue;
        root.file().fail(cutters[n]->source(),
                         "[dynamics] estimates the modes of this cutter, and it has no 'stickout_mm'",
                         "add stickout_mm, from the tip to the holder's face");
    }
    const toml::source_position place = table.get("estimate")->source().begin;
    return JobEstimate{static_cast<int>(place.line), static_cast<int>(place.column)};
}

template <class Named>
std::vector<std::string_view> names_of(std::span<const Named> all) {
    std::vector<std::string_view> names;
    for (const Named& n : all) names.push_back(n.name);
    return names;
}

JobSound read_sound(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[sound]", kSoundKeys);
    JobSound sound;
    sound.listener_mm = section.point("listener_mm");
    sound.distance_factor =
        section.number("distance_factor", kLimits.distance_factor).value_or(sound.distance_factor);
    sound.reference_distance_m = section.number("reference_distance_m", kLimits.reference_distance)
                                     .value_or(sound.reference_distance_m);
    sound.gain_db = section.number("gain_db", kLimits.gain).value_or(sound.gain_db);
    sound.bits = section.integer("bits", kLimits.sample_bits).value_or(sound.bits);
    if (sound.bits != 16 && sound.bits != 24 && sound.bits != 32) {
        section.fail("bits", "'bits' is " + std::to_string(sound.bits), "try 16, 24 or 32");
    }
    if (const auto mode = section.word("mode", kSoundModes)) sound.mode = static_cast<SoundMode>(*mode);
    sound.hrtf = section.path("hrtf").value_or("");
    if (!sound.hrtf.empty() && sound.mode && *sound.mode != SoundMode::hrtf) {
        section.fail("hrtf", "'hrtf' names a file, but the mode does not use it",
                     "write mode = \"hrtf\" or remove it");
    }
    sound.as_measured = section.word("equalize", kEqualizations).value_or(0) == 1;
    if (section.has("equalize") && sound.mode.value_or(SoundMode::hrtf) != SoundMode::hrtf) {
        section.fail("equalize", "'equalize' is for measured heads, but the mode uses none",
                     "write mode = \"hrtf\" or remove it");
    }
    sound.recording = section.path("recording").value_or("");
    sound.idle_recording = section.path("idle_recording").value_or("");
    sound.chips = section.path("chips").value_or("");
    // The speed at which something was recorded belongs to the recording, and the other way round.
    const auto recorded_rpm = [&](std::string_view file, std::string_view key, bool there) {
        if (there) return section.required_number(key, kLimits.spindle_speed);
        if (section.has(key)) {
            section.fail(key, "'" + std::string(key) + "' belongs to '" + std::string(file) + "'",
                         "name the recording, or remove it");
        }
        return 0.0;
    };
    sound.recording_rpm = recorded_rpm("recording", "recording_rpm", !sound.recording.empty());
    sound.idle_recording_rpm =
        recorded_rpm("idle_recording", "idle_recording_rpm", !sound.idle_recording.empty());
    if (sound.recording.empty() && section.has("recording_share")) {
        section.fail("recording_share", "'recording_share' belongs to 'recording'",
                     "name the recording, or remove it");
    }
    sound.recording_share =
        section.number("recording_share", kLimits.recording_share).value_or(sound.recording_share);
    if (const auto n = section.word("machine", names_of(sound::machines())))
        sound.machine = sound::machines()[*n].name;
    // Force and vibration alone have no room around them, unless one is asked for.
    if (sound.machine == sound::machines()[0].name) sound.room = sound::rooms()[0].name;
    if (const auto n = section.word("room", names_of(sound::rooms()))) sound.room = sound::rooms()[*n].name;
    const auto level = [&](std::string_view key) { return section.number(key, kLimits.level).value_or(0); };
    sound.cut_db = level("cut_db");
    sound.spindle_db = level("spindle_db");
    sound.chips_db = level("chips_db");
    sound.room_db = level("room_db");
    return sound;
}

JobHaptics read_haptics(TomlFile& file, const toml::table& table) {
    TomlSection section(file, table, "[haptics]", kHapticsKeys);
    JobHaptics haptics;
    haptics.force_scale = section.number("force_scale", kLimits.force_scale).value_or(haptics.force_scale);
    haptics.profile = section.path("profile").value_or("");
    haptics.probe = static_cast<ProbeKind>(section.word("probe", kProbeWords).value_or(0));
    haptics.friction_static = section.number("friction_static", kLimits.friction);
    haptics.friction_kinetic = section.number("friction_kinetic", kLimits.friction);
    if (haptics.friction_static && haptics.friction_kinetic &&
        *haptics.friction_kinetic > *haptics.friction_static) {
        section.fail("friction_kinetic", "'friction_kinetic' is above 'friction_static'", "exchange them");
    }
    haptics.stiffness_n_per_mm = section.number("stiffness_n_per_mm", kLimits.surface_stiffness);
    return haptics;
}

}  // namespace tribo::job
