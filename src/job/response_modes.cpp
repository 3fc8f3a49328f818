// SPDX-License-Identifier: MIT
#include "job/response_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text/limit_text.hpp"

namespace tribo::job {
namespace {

// Beyond, the modes do not say how the machine vibrates.
constexpr double kLargeResidual = 0.1;
// What is read of a file, and the numbers that it becomes, beside its bytes.
constexpr std::uint64_t kCopies = 4;

}  // namespace

Result<dynamics::ModeFit> fit_response(const readers::FrequencyResponse& response, const JobFrf& wanted,
                                       Warnings& warnings) {
    const auto warn = [&](std::string text) {
        warnings.push_back({wanted.file, response.line, std::move(text)});
    };
    warnings.insert(warnings.end(), response.warnings.begin(), response.warnings.end());
    dynamics::ModeFitOptions options;
    if (wanted.from_hz) options.from_hz = *wanted.from_hz;
    if (wanted.to_hz) options.to_hz = *wanted.to_hz;
    options.modes = wanted.modes;
    options.derivatives = response.derivatives;
    auto fit = dynamics::fit_modes(response.frequency_hz, response.receptance_mm_per_n, options);
    if (!fit) {
        Error error = std::move(fit).error();
        error.file = wanted.file;
        error.line = response.line;
        return std::unexpected(std::move(error));
    }
    if (fit->other_time_sign)
        warn("the imaginary part has the sign of e^(-iwt); it is read with the other sign");
    if (fit->other_force_sign) {
        warn(
            "the response goes against the force, as if hammer and sensor pointed against each other; it is "
            "read with the other sign");
    }
    if (fit->residual > kLargeResidual) {
        warn("the fitted modes leave a residual of " + plain_number(std::round(1000 * fit->residual) / 10) +
             " %; choose the band around the peaks with band_hz, or measure again");
    }
    return fit;
}

FileResult<void> add_fitted_modes(const FileSource& files, Job& job, std::uint64_t memory_bytes,
                                  Warnings& warnings) {
    const std::uint64_t limit =
        memory_bytes == 0 ? kLargestResponseBytes : std::min(kLargestResponseBytes, memory_bytes / kCopies);
    for (JobFrf& frf : job.frfs) {
        const FileResult<std::string> bytes = files.read(frf.file, limit);
        if (!bytes) return std::unexpected(bytes.error());
        const auto response = readers::read_frequency_response(
            *bytes, {.source_name = frf.file, .direction = frf.direction, .unit = frf.unit});
        if (!response) return std::unexpected(FileFailure(response.error()));
        auto fit = fit_response(*response, frf, warnings);
        if (!fit) return std::unexpected(FileFailure(fit.error()));
        for (const dynamics::FittedMode& mode : fit->modes) {
            job.modes.push_back(
                {frf.direction, mode.frequency_hz, mode.damping_ratio, mode.stiffness_n_per_mm, frf.on});
        }
        frf.fit = *std::move(fit);
    }
    return {};
}

}  // namespace tribo::job
