// SPDX-License-Identifier: MIT
#include "milling/tool/materials.hpp"

#include <utility>

#include "base/math.hpp"
#include "base/text/nearest.hpp"

namespace tribo::milling {
namespace {

constexpr char kNoAxial[] =
    "the source has no axial coefficients; 0 is assumed, so the axial force is missing";

// Lowest and highest Ktc of one alloy in the sources below, N/mm2.
struct Range {
    double low, high;
};
constexpr Range k7075{600.46, 1319.41}, k6061{243.77, 796};

// Public code confirms chip ratio and friction angle, but not shear stress and edge forces.
constexpr OrthogonalData kTi6Al4V{.shear_stress_n_per_mm2 = 613,
                                  .ratio = 1.755,
                                  .ratio_per_deg = -0.028,
                                  .exponent = 0.331,
                                  .exponent_per_deg = -0.0082,
                                  .friction_deg = 19.1,
                                  .friction_deg_per_deg = 0.29,
                                  .kte = 24,
                                  .kre = 43,
                                  .kae = 0};
constexpr double kTi6Al4VRakeDeg = 12, kTi6Al4VHelixDeg = 30, kTi6Al4VChipMm = 0.05;

// The steel set is given as a resultant and its angle to the radial direction.
constexpr double kSteelResultant = 2160, kSteelAngleDeg = 68;

// A row of the table of the review. It prints the edge coefficients in N mm; the unit must be N/mm.
WorkpieceMaterial review(std::string name, std::string what, const char* reference,
                         const CuttingCoefficients& k, std::string note = {}) {
    return {
        std::move(name),
        std::move(what),
        std::string("review of milling force models for aerospace aluminium alloys, Chinese J. Mech. Eng. "
                    "2021, doi 10.1186/s10033-021-00536-9, Table 5, reference ") +
            reference,
        std::move(note),
        Confidence::published,
        k,
        0.5,
        2};
}

WorkpieceMaterial within(WorkpieceMaterial m, Range ktc) {
    m.spread_low = ktc.low / m.coefficients.ktc;
    m.spread_high = ktc.high / m.coefficients.ktc;
    return m;
}

WorkpieceMaterial suspect(WorkpieceMaterial m) {
    m.confidence = Confidence::suspect;
    return m;
}

}  // namespace

std::vector<WorkpieceMaterial> materials() {
    std::vector<WorkpieceMaterial> all;
    all.push_back(
        within(review("al7075-t6", "Al7075-T6, carbide, dry", "190",
                      {.ktc = 767.01, .krc = 168.8, .kac = 222, .kte = 27.7, .kre = 26.6, .kae = 0.7}),
               k7075));
    all.push_back(within(review("al7075-t6-dry2", "Al7075-T6, carbide, dry", "160",
                                {.ktc = 600.46, .krc = 180.96, .kte = 17.9, .kre = 20.42}, kNoAxial),
                         k7075));
    all.push_back(within(
        review("al7075-hss", "Al7075, high-speed steel, dry", "156",
               {.ktc = 951.365, .krc = 262.597, .kac = 323.33, .kte = 11.115, .kre = 11.314, .kae = 1.105}),
        k7075));
    all.push_back(
        within(review("al7075", "Al7075, carbide, dry", "47",
                      {.ktc = 1319.41, .krc = 788.83, .kac = 48.75, .kte = 19.65, .kre = 26.77, .kae = 2.05}),
               k7075));
    all.push_back(within(review("al6061-t6", "Al6061-T6, carbide, dry", "160",
                                {.ktc = 243.77, .krc = 113.5, .kte = 7.53, .kre = 7.83}, kNoAxial),
                         k6061));
    all.push_back(within({"al6061",
                          "Al6061, set of a public simulator",
                          "parameters of an open milling twin in Unity",
                          "the origin of the values is not given; no axial edge coefficient, 0 is assumed",
                          Confidence::unconfirmed,
                          {.ktc = 796, .krc = 168, .kac = 80, .kte = 14.5, .kre = 10.2}},
                         k6061));
    all.push_back(review("al6082-t6", "Al6082-T6, carbide, dry", "189",
                         {.ktc = 631, .krc = 99, .kac = 273, .kte = 13, .kre = 10, .kae = 2.8}));
    all.push_back(
        suspect(review("almgsi0.5-mql", "AlMgSi0.5, carbide, minimum quantity lubrication", "150",
                       {.ktc = 561.2, .krc = 194.4, .kac = 6.7, .kte = 204.3, .kre = 16.2, .kae = 2.2},
                       "kte is ten times its neighbours' and may be a misprint")));

    WorkpieceMaterial titanium{
        "ti6al4v",
        "Ti6Al4V, carbide, rake 12, helix 30 degrees, chip 0.05 mm",
        "orthogonal data of Budak, Altintas, Armarego 1996 through the oblique transformation",
        "shear stress 613 N/mm2 and edge forces 24 and 43 N/mm are quoted, not checked in the "
        "paper; no axial edge coefficient, 0 is assumed",
        Confidence::unconfirmed,
        {}};
    titanium.coefficients = oblique_coefficients(kTi6Al4V, kTi6Al4VRakeDeg * math::kRadPerDeg,
                                                 kTi6Al4VHelixDeg * math::kRadPerDeg, kTi6Al4VChipMm);
    all.push_back(std::move(titanium));

    all.push_back(
        {"gh909",
         "GH909 superalloy, 10 mm one-flute cutter, helix 30 degrees, 1000 rpm",
         "OwenFrost1994, Paper_Identification_cuttingforce_coefficients_machining_considering_vibration",
         "identified from one slot, 0.2 mm deep",
         Confidence::unconfirmed,
         {.ktc = 3250.03, .krc = 1200.5, .kac = 251.55, .kte = 90.85, .kre = 115.11, .kae = 52.94}});

    double sine, cosine;
    math::sincos(kSteelAngleDeg * math::kRadPerDeg, sine, cosine);
    all.push_back({"steel",
                   "steel, 12.7 mm four-flute cutter, 4000 to 7000 rpm",
                   "acornel5, Bayesian-stability-and-cutting-force: 2160 N/mm2 at 68 degrees",
                   "grade not named; radial edge and axial coefficients are missing, 0 is assumed",
                   Confidence::unconfirmed,
                   {.ktc = kSteelResultant * sine, .krc = kSteelResultant * cosine, .kte = 50}});
    return all;
}

Result<WorkpieceMaterial> find_material(std::string_view name) {
    std::vector<WorkpieceMaterial> all = materials();
    std::vector<std::string_view> names;
    for (WorkpieceMaterial& m : all) {
        if (m.name == name) return std::move(m);
        names.push_back(m.name);
    }
    return fail("unknown material '" + std::string(name) + "'",
                suggestion(name, names) + ", or give ktc_n_per_mm2 and the other coefficients");
}

std::string_view name_of(Confidence confidence) {
    return confidence == Confidence::published     ? "published"
           : confidence == Confidence::unconfirmed ? "unconfirmed"
                                                   : "suspect";
}

}  // namespace tribo::milling
