// SPDX-License-Identifier: MIT
#include "files/sound/hrir_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <mysofa.h>

#include "files/sha256.hpp"

namespace tribo::files {
namespace {

constexpr const char* kShipped = "/usr/share/libmysofa/MIT_KEMAR_normal_pinna.sofa";
// SHA-256 of libmysofa 1.3's MIT_KEMAR_normal_pinna.sofa.
constexpr std::string_view kShippedHash = "2768ac841213a7ae11d1ea7fd0f25a69b39216102dc5dd913ea6ba0f0dc57e28";
constexpr std::uint64_t kLargestShipped = 4 << 20;

struct Freed {
    void operator()(MYSOFA_HRTF* hrtf) const { mysofa_free(hrtf); }
};
using Hrtf = std::unique_ptr<MYSOFA_HRTF, Freed>;

std::string cause_of(int error) {
    switch (error) {
        case MYSOFA_INVALID_FORMAT:
            return "is no SOFA file, or a damaged one";
        case MYSOFA_UNSUPPORTED_FORMAT:
            return "is of a kind of SOFA that is not supported";
        case MYSOFA_NO_MEMORY:
            return "needs more memory than a set of head responses may";
        case MYSOFA_READ_ERROR:
            return "cannot be read, or is cut off";
        case MYSOFA_INVALID_ATTRIBUTES:
            return "lacks the attributes of a SOFA file";
        case MYSOFA_INVALID_DIMENSIONS:
        case MYSOFA_INVALID_DIMENSION_LIST:
            return "has dimensions that do not fit each other";
        case MYSOFA_INVALID_COORDINATE_TYPE:
            return "has coordinates of an unknown kind";
        case MYSOFA_ONLY_THE_SAME_SAMPLING_RATE_SUPPORTED:
            return "has more than one sample rate";
        case MYSOFA_INVALID_RECEIVER_POSITIONS:
        case MYSOFA_RECEIVERS_WITH_RCI_SUPPORTED:
        case MYSOFA_RECEIVERS_WITH_CARTESIAN_SUPPORTED:
            return "does not place two ears";
        default:
            return "holds no head responses (libmysofa error " + std::to_string(error) + ")";
    }
}

std::unexpected<Error> refused(std::string cause) {
    return fail(std::move(cause), "try another SOFA file, or leave 'hrtf' out for the built-in set");
}

bool fits(const MYSOFA_ARRAY& array, std::size_t least) {
    return array.values != nullptr && array.elements >= least;
}

// The listener of SOFA looks along +x with +y to the left; the head here along +y with +x to the right.
Result<sound::HrirSet> set_of(MYSOFA_HRTF& h) {
    // The file may store either ear first. The left one has the larger y, and libmysofa expects it first, at
    // +y. Finally the responses themselves decide (sound::ear_order).
    constexpr float kEarM = 0.09F;
    const bool swapped =
        fits(h.ReceiverPosition, 6) && h.ReceiverPosition.values[1] < h.ReceiverPosition.values[4];
    if (fits(h.ReceiverPosition, 6)) {
        constexpr std::array<float, 6> kLeftFirst{0, kEarM, 0, 0, -kEarM, 0};
        std::ranges::copy(kLeftFirst, h.ReceiverPosition.values);
    }
    if (const int error = mysofa_check(&h); error != MYSOFA_OK) return refused(cause_of(error));
    const std::size_t m = h.M, n = h.N, r = h.R;
    constexpr std::size_t kMost = std::size_t{1} << 27;  // samples, half a gigabyte
    if (r != 2) return refused("has " + std::to_string(r) + " receivers, not two ears");
    if (m == 0 || n == 0 || n > kMost / 2 / m) return refused("has no responses, or too many");
    if (!fits(h.DataIR, m * 2 * n) || !fits(h.SourcePosition, 3 * m) || !fits(h.DataSamplingRate, 1) ||
        !fits(h.ReceiverPosition, 6) || !(fits(h.DataDelay, 2))) {
        return refused("is shorter than it claims");
    }
    mysofa_tocartesian(&h);
    sound::HrirSet set;
    set.sample_rate_hz = static_cast<double>(h.DataSamplingRate.values[0]);
    set.taps = static_cast<int>(n);
    const bool delay_each = h.DataDelay.elements >= 2 * m;
    for (std::size_t k = 0; k < m; ++k) {
        const float* p = h.SourcePosition.values + 3 * k;
        const Vec3 place{-static_cast<double>(p[1]), static_cast<double>(p[0]), static_cast<double>(p[2])};
        set.directions.push_back(normalized(place, {0, 0, 0}));
        for (std::size_t ear = 0; ear < 2; ++ear) {
            const std::size_t from = swapped ? 1 - ear : ear;
            const float* response = h.DataIR.values + (2 * k + from) * n;
            set.responses.insert(set.responses.end(), response, response + n);
            const auto samples = static_cast<double>(h.DataDelay.values[delay_each ? 2 * k + from : from]);
            set.extra_delays_s.push_back(samples / set.sample_rate_hz);
        }
    }
    if (auto ok = sound::check_hrirs(set); !ok) return std::unexpected(ok.error());
    return set;
}

}  // namespace

FileResult<sound::HrirSet> builtin_hrirs() {
    auto bytes = read_file(kShipped, kLargestShipped);
    if (!bytes) return std::unexpected(bytes.error());
    if (sha256(*bytes) != kShippedHash) {
        return std::unexpected(FileFailure({kShipped, 0, 0, "is not the set that libmysofa 1.3 ships",
                                            "name it as 'hrtf' of [sound] to use it all the same"}));
    }
    int error = MYSOFA_OK;
    const Hrtf hrtf(mysofa_load_data(bytes->data(), bytes->size(), &error));
    if (!hrtf) return std::unexpected(FileFailure({kShipped, 0, 0, cause_of(error), ""}));
    auto set = set_of(*hrtf);
    if (!set) return std::unexpected(FileFailure({kShipped, 0, 0, set.error().cause, set.error().remedy}));
    return std::move(*set);
}

Result<sound::HrirSet> hrirs_of_sofa(const std::string& path) {
    int error = MYSOFA_OK;
    const Hrtf hrtf(mysofa_load(path.c_str(), &error));
    if (!hrtf) return refused(cause_of(error));
    return set_of(*hrtf);
}

}  // namespace tribo::files
