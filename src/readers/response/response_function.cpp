// SPDX-License-Identifier: MIT
#include "readers/response/response_function.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "readers/text/model_text.hpp"
#include "readers/text/text_lines.hpp"

namespace tribo::readers {
namespace {

using namespace std::string_view_literals;

constexpr int kTime = 1, kFrequencyResponse = 4;              // kinds of functions
constexpr int kUnknown = 0, kGeneral = 1, kDisplacement = 8;  // types of axes
constexpr int kReactionForce = 9, kVelocity = 11, kAcceleration = 12, kExcitationForce = 13;
constexpr int kFrequency = 18;
constexpr std::array kQuantities{"receptance"sv, "mobility"sv, "accelerance"sv};
constexpr const char* kStateUnit = "state it as unit = \"m/s2/N\" or another one of docs/job.md";

// The start of a unit as writers spell it: m/s^2, (m/s²)/N, g's, mm/sec².
std::string plain_unit(std::string_view text) {
    std::string plain;
    for (std::size_t n = 0; n < text.size(); ++n) {
        const auto byte = static_cast<unsigned char>(text[n]);
        if (byte == 0xC2 && n + 1 < text.size()) continue;
        if (byte == 0xB2) plain += '2';
        if (byte == 0xB5) plain += 'u';
        if (byte < 0x80 && !is_blank(text[n]) && "()^'*[]"sv.find(text[n]) == std::string_view::npos)
            plain += text[n];
    }
    return plain;
}

struct LabelUnit {
    std::string_view name;
    int derivatives;
    double mm;
};
constexpr std::array kMotionUnits{LabelUnit{"m", 0, 1e3},
                                  LabelUnit{"mm", 0, 1},
                                  LabelUnit{"um", 0, 1e-3},
                                  LabelUnit{"in", 0, 25.4},
                                  LabelUnit{"m/s", 1, 1e3},
                                  LabelUnit{"mm/s", 1, 1},
                                  LabelUnit{"in/s", 1, 25.4},
                                  LabelUnit{"m/s2", 2, 1e3},
                                  LabelUnit{"m/s/s", 2, 1e3},
                                  LabelUnit{"m/sec2", 2, 1e3},
                                  LabelUnit{"mm/s2", 2, 1},
                                  LabelUnit{"in/s2", 2, 25.4},
                                  LabelUnit{"g", 2, kGravityMmPerS2},
                                  LabelUnit{"gs", 2, kGravityMmPerS2},
                                  LabelUnit{"gn", 2, kGravityMmPerS2}};

std::optional<LabelUnit> unit_of_label(std::string_view text) {
    std::string plain = plain_unit(text);
    for (const std::string_view force : {"/N"sv, "/lbf"sv, "/lb"sv})
        if (plain.ends_with(force)) plain.erase(plain.size() - force.size());
    const auto found = std::ranges::find(kMotionUnits, plain, &LabelUnit::name);
    return found == kMotionUnits.end() ? std::nullopt : std::optional(*found);
}

// The force of one unit, in N.
std::optional<double> force_of_label(std::string_view text) {
    const std::string plain = plain_unit(text);
    if (plain == "N") return 1;
    if (plain == "kN") return 1000;
    if (plain == "lbf" || plain == "lb") return kPoundForceN;
    return std::nullopt;
}

std::optional<int> derivatives_of_name(std::string_view label) {
    struct Word {
        std::string_view begin;
        int derivatives;
    };
    constexpr std::array kWords{Word{"displ", 0}, Word{"recept", 0}, Word{"compl", 0}, Word{"veloc", 1},
                                Word{"mobil", 1}, Word{"accel", 2},  Word{"inert", 2}};
    std::string lower;
    for (const char c : label) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    for (const Word& word : kWords)
        if (lower.find(word.begin) != std::string::npos) return word.derivatives;
    return std::nullopt;
}

std::string direction_name(int direction) {
    if (direction == 0 || std::abs(direction) > 3) return "";
    return std::string(direction < 0 ? " -" : " +") + "xyz"[std::abs(direction) - 1];
}

std::string place_name(const UniversalPoint& point) {
    std::string name;
    if (!point.name.empty() && !equals_ignoring_case(point.name, "NONE")) name = " " + quoted(point.name);
    if (point.node != 0 || name.empty()) name += " node " + std::to_string(point.node);
    return name + direction_name(point.direction);
}

std::string function_name(const UniversalFunction& f) {
    return "response at" + place_name(f.response) + " to a force at" + place_name(f.reference);
}

bool same_place(const UniversalFunction& f) {
    return f.response.node == f.reference.node && f.response.name == f.reference.name &&
           std::abs(f.response.direction) == std::abs(f.reference.direction);
}

// A complex function of frequency over a force, or over what may be one.
bool is_response(const UniversalFunction& f, bool unit_is_stated) {
    const int over = f.denominator.type, of = f.numerator.type;
    const bool over_force =
        over == kExcitationForce || over == kReactionForce || over == kUnknown || over == kGeneral;
    const bool of_motion =
        of == kDisplacement || of == kVelocity || of == kAcceleration || of == kUnknown || of == kGeneral;
    const bool over_frequency = f.abscissa.type == kFrequency || f.abscissa.type == kUnknown;
    return f.kind == kFrequencyResponse && f.is_complex && over_frequency &&
           (unit_is_stated || (over_force && of_motion));
}

std::string what_it_holds(const std::vector<UniversalFunction>& functions) {
    std::map<std::string, int> counts;
    for (const UniversalFunction& f : functions) {
        if (f.kind == kTime) {
            ++counts["time responses"];
        } else if (f.kind == kFrequencyResponse) {
            ++counts[f.is_complex ? "frequency responses that are not over a force"
                                  : "frequency responses without phases"];
        } else {
            ++counts["functions of other kinds"];
        }
    }
    std::string text;
    for (const auto& [kind, count] : counts)
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
    return text.empty() ? "no dataset 58" : text;
}

class Chooser {
  public:
    Chooser(const std::vector<UniversalFunction>& functions, const ResponseOptions& options,
            Warnings& warnings)
        : functions_(functions), options_(options), warnings_(warnings) {}

    Result<ChosenResponse> choose() {
        std::vector<const UniversalFunction*> all, driving;
        for (const UniversalFunction& f : functions_) {
            if (!is_response(f, options_.unit != nullptr)) continue;
            all.push_back(&f);
            if (same_place(f)) driving.push_back(&f);
        }
        if (all.empty()) {
            return fail_at(
                options_.source_name, functions_.empty() ? 0 : functions_[0].line, 0,
                "the file holds no frequency response over a force, but " + what_it_holds(functions_),
                "export a frequency response (displacement, velocity or acceleration over force)");
        }
        const auto picked = pick(all, driving);
        if (!picked) return std::unexpected(picked.error());
        const UniversalFunction& f = **picked;
        const auto unit = unit_of(f);
        if (!unit) return std::unexpected(unit.error());
        ChosenResponse chosen{&f, *unit, 1, {}};
        const int product = f.response.direction * f.reference.direction;
        if (product < 0 && std::abs(f.response.direction) <= 3) chosen.sign = -1;
        chosen.description = std::string(kQuantities[static_cast<std::size_t>(unit->derivatives)]) +
                             ", dataset " + (f.is_binary ? "58b" : "58") + ", " + function_name(f);
        return chosen;
    }

  private:
    void warn(int line, std::string text) {
        warnings_.push_back({options_.source_name, line, std::move(text)});
    }

    // Whether a direction of the file is the one that is asked for.
    bool is_along(int direction) const {
        const int axis = std::abs(direction) - 1;
        if (!options_.direction || direction == 0 || axis > 2) return false;
        const Vec3 d = *options_.direction;
        const double parts[] = {d.x, d.y, d.z};
        constexpr double kAlong = 0.9;  // cosine
        return std::abs(parts[axis]) >= kAlong * length(d);
    }

    Result<const UniversalFunction*> pick(const std::vector<const UniversalFunction*>& all,
                                          const std::vector<const UniversalFunction*>& driving) {
        std::vector<const UniversalFunction*> along;
        for (const UniversalFunction* f : driving)
            if (is_along(f->reference.direction)) along.push_back(f);
        const std::vector<const UniversalFunction*>& best = !along.empty() ? along : driving;
        if (best.empty()) {
            if (all.size() > 1) {
                return fail_at(options_.source_name, all[0]->line, 0,
                               "none of the " + std::to_string(all.size()) +
                                   " frequency responses is of a driving point; the first is the " +
                                   function_name(*all[0]),
                               "export the one whose response is where the force is, alone");
            }
            warn(all[0]->line, "the " + function_name(*all[0]) + " is taken as that of a driving point");
            return all[0];
        }
        if (best.size() > 1) {
            warn(best[0]->line, "of " + std::to_string(best.size()) +
                                    " driving points the first is taken: the " + function_name(*best[0]));
        } else if (all.size() > 1 && along.empty() && options_.direction) {
            warn(best[0]->line, "the only driving point is taken: the " + function_name(*best[0]));
        }
        const int axis = std::abs(best[0]->reference.direction);
        if (along.empty() && options_.direction && axis >= 1 && axis <= 3) {
            warn(best[0]->line, "the file says" + direction_name(best[0]->reference.direction) +
                                    ", which is not the direction that is stated; the stated one counts");
        }
        return best[0];
    }

    Result<ResponseUnit> unit_of(const UniversalFunction& f) {
        if (options_.unit) return *options_.unit;
        const std::optional<LabelUnit> label = unit_of_label(f.numerator.unit);
        const auto unknown = [&](std::string cause) {
            return fail_at(options_.source_name, f.line, 0, std::move(cause), kStateUnit);
        };
        std::optional<int> derivatives;
        if (f.numerator.type == kDisplacement) derivatives = 0;
        if (f.numerator.type == kVelocity) derivatives = 1;
        if (f.numerator.type == kAcceleration) derivatives = 2;
        if (!derivatives) {
            derivatives = derivatives_of_name(f.numerator.label);
            if (label && derivatives && label->derivatives != *derivatives) {
                return unknown("the response is called " + quoted(f.numerator.label) + " and has the unit " +
                               quoted(f.numerator.unit));
            }
            if (label) derivatives = label->derivatives;
            if (!derivatives) return unknown("the file does not say what the response is");
            warn(f.line, "the type of the response is not stated; by its name or unit it is taken as " +
                             std::string(kQuantities[static_cast<std::size_t>(*derivatives)]));
        }
        const std::optional<double> force = force_of_label(f.denominator.unit);
        ResponseUnit unit{"", *derivatives, 1e3};
        const bool label_fits = label && label->derivatives == *derivatives;
        if (f.units) {
            unit.mm_per_n = 1e3 * f.units->force / f.units->length;
            if (label_fits && !is_near(unit.mm_per_n, label->mm / force.value_or(1))) {
                warn(f.line, "the unit is called " + quoted(f.numerator.unit) + " over " +
                                 quoted(f.denominator.unit) +
                                 ", but the numbers are in those of dataset 164; these count");
            }
        } else if (label_fits) {
            unit.mm_per_n = label->mm / force.value_or(1);
            if (!is_near(unit.mm_per_n, 1e3)) {
                warn(f.line, "no dataset 164 states units; the numbers are taken to be in " +
                                 quoted(f.numerator.unit) + " over " +
                                 (force ? quoted(f.denominator.unit) : "N"));
            }
        }
        return unit;
    }

    static bool is_near(double a, double b) { return std::abs(a - b) <= 1e-4 * std::abs(b); }

    const std::vector<UniversalFunction>& functions_;
    const ResponseOptions& options_;
    Warnings& warnings_;
};

}  // namespace

Result<ChosenResponse> choose_response(const std::vector<UniversalFunction>& functions,
                                       const ResponseOptions& options, Warnings& warnings) {
    return Chooser(functions, options, warnings).choose();
}

}  // namespace tribo::readers
