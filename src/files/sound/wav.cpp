// SPDX-License-Identifier: MIT
#include "files/sound/wav.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <optional>
#include <sndfile.h>
#include <unistd.h>
#include <utility>

#include "base/noise_hash.hpp"
#include "files/pending_file.hpp"

namespace tribo::files {
namespace {

constexpr std::int64_t kLargestFileBytes = 0xffffffff;  // 32-bit length of RIFF
constexpr std::int64_t kHeaderBytes = 1024;             // upper limit of the headers written here

// The file as seen by libsndfile. It keeps the error numbers of the system.
struct OpenFile {
    int descriptor = -1;
    int error_number = 0;
    sf_count_t at = 0, length = 0;

    static sf_count_t tell_length(void* self) { return static_cast<OpenFile*>(self)->length; }
    static sf_count_t seek(sf_count_t offset, int whence, void* self) {
        auto& file = *static_cast<OpenFile*>(self);
        file.at = offset + (whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.at : file.length);
        return file.at;
    }
    static sf_count_t read(void*, sf_count_t, void*) { return 0; }
    static sf_count_t write(const void* bytes, sf_count_t count, void* self) {
        auto& file = *static_cast<OpenFile*>(self);
        sf_count_t done = 0;
        while (done < count && file.error_number == 0) {
            const ssize_t n = ::pwrite(file.descriptor, static_cast<const char*>(bytes) + done,
                                       static_cast<std::size_t>(count - done), file.at + done);
            if (n > 0) {
                done += n;
            } else if (n == 0) {
                file.error_number = ENOSPC;
            } else if (errno != EINTR) {
                file.error_number = errno;
            }
        }
        file.at += done;
        file.length = std::max(file.length, file.at);
        return done;
    }
    static sf_count_t tell(void* self) { return static_cast<OpenFile*>(self)->at; }
};

SF_VIRTUAL_IO callbacks() {
    return {OpenFile::tell_length, OpenFile::seek, OpenFile::read, OpenFile::write, OpenFile::tell};
}

// Converts to integers of `bits` bits, rounded. NaN becomes silence.
double quantized(float sample, int bits, double dither_steps) {
    const double scale = static_cast<double>(1 << (bits - 1));
    if (sample != sample) return 0;
    return std::clamp(std::floor(static_cast<double>(sample) * scale + dither_steps + 0.5), -scale,
                      scale - 1);
}

std::unexpected<FileFailure> refused_file(const std::string& path, std::string cause, std::string remedy) {
    return std::unexpected(FileFailure({path, 0, 0, std::move(cause), std::move(remedy)}));
}

}  // namespace

struct WavWriter::State {
    std::string path;
    WavFormat format;
    std::int64_t longest_frames = 0;
    OpenFile file;
    std::optional<PendingFile> pending;
    SF_VIRTUAL_IO io = callbacks();
    SNDFILE* container = nullptr;
    CounterNoise dither{0};
    std::int64_t frames = 0;
    bool too_long = false;
    bool broken = false;  // libsndfile failed without an error of the system

    ~State() {
        if (container != nullptr) ::sf_close(container);
    }

    template <class Sample, class Convert>
    void write_as(std::span<const float> interleaved, Convert&& convert,
                  sf_count_t (*writer)(SNDFILE*, const Sample*, sf_count_t)) {
        std::array<Sample, 4096> block;
        auto sample = static_cast<std::uint64_t>(frames * format.channels);
        while (!interleaved.empty() && !broken) {
            const std::size_t n = std::min(interleaved.size(), block.size());
            for (std::size_t i = 0; i < n; ++i) block[i] = convert(interleaved[i], sample++);
            broken =
                writer(container, block.data(), static_cast<sf_count_t>(n)) != static_cast<sf_count_t>(n);
            interleaved = interleaved.subspan(n);
        }
    }
};

std::int64_t longest_wav_frames(const WavFormat& format) {
    return (kLargestFileBytes - kHeaderBytes) / (format.channels * (format.bits / 8));
}

WavWriter::WavWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
WavWriter::WavWriter(WavWriter&&) noexcept = default;
WavWriter::~WavWriter() = default;

FileResult<WavWriter> WavWriter::create(const std::string& path, const WavFormat& format,
                                        std::int64_t longest_frames) {
    if (format.bits != 16 && format.bits != 24 && format.bits != 32) {
        return refused_file(path, std::to_string(format.bits) + " bits per sample",
                            "try bits = 16, 24 or 32");
    }
    if (format.sample_rate_hz < 8000 || format.sample_rate_hz > 192000) {
        return refused_file(path, "a sample rate of " + std::to_string(format.sample_rate_hz) + " Hz",
                            "try 48000 or 44100");
    }
    if (format.channels < 1 || format.channels > 8) {
        return refused_file(path, std::to_string(format.channels) + " channels", "try 2");
    }
    auto state = std::make_unique<State>();
    state->path = path;
    state->format = format;
    state->longest_frames = std::min(longest_frames, longest_wav_frames(format));
    state->dither = CounterNoise(format.dither_seed);
    FileResult<PendingFile> file = PendingFile::open(path);
    if (!file) return std::unexpected(std::move(file).error());
    state->pending.emplace(*std::move(file));
    state->file.descriptor = state->pending->descriptor();

    SF_INFO info = {};
    info.samplerate = format.sample_rate_hz;
    info.channels = format.channels;
    info.format = SF_FORMAT_WAV | (format.bits == 16   ? SF_FORMAT_PCM_16
                                   : format.bits == 24 ? SF_FORMAT_PCM_24
                                                       : SF_FORMAT_FLOAT);
    state->container = ::sf_open_virtual(&state->io, SFM_WRITE, &info, &state->file);
    if (state->container == nullptr) {
        const int error_number = state->file.error_number;
        return system_failure(path, "write", error_number != 0 ? error_number : EIO);
    }
    // The PEAK chunk of float files would contain the time of day.
    ::sf_command(state->container, SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
    return WavWriter(std::move(state));
}

void WavWriter::write(std::span<const float> interleaved) {
    State& s = *state_;
    assert(interleaved.size() % static_cast<std::size_t>(s.format.channels) == 0);
    const auto frames = static_cast<std::int64_t>(interleaved.size()) / s.format.channels;
    if (s.too_long || s.broken) return;
    if (frames > s.longest_frames - s.frames) {
        s.too_long = true;
        return;
    }
    switch (s.format.bits) {
        case 16:
            s.write_as<short>(
                interleaved,
                [&](float v, std::uint64_t sample) {
                    const std::uint64_t b = s.dither.bits(sample);
                    // The sum of two uniform numbers of one step's width is triangular.
                    const double two = static_cast<double>(b & 0xffffffff) + static_cast<double>(b >> 32);
                    return static_cast<short>(quantized(v, 16, v == 0 ? 0 : two * 0x1p-32 - 1));
                },
                ::sf_write_short);
            break;
        case 24:
            // libsndfile uses the upper 24 of 32 bits.
            s.write_as<int>(
                interleaved,
                [](float v, std::uint64_t) { return static_cast<int>(quantized(v, 24, 0)) * 256; },
                ::sf_write_int);
            break;
        default:
            s.write_as<float>(interleaved, [](float v, std::uint64_t) { return v; }, ::sf_write_float);
            break;
    }
    s.frames += frames;
}

std::int64_t WavWriter::frames() const {
    return state_->frames;
}

FileResult<void> WavWriter::finish() {
    State& s = *state_;
    const int closed = ::sf_close(std::exchange(s.container, nullptr));  // writes the lengths
    if (s.too_long) {
        return refused_file(s.path,
                            "the sound is longer than the " +
                                std::to_string(s.longest_frames / s.format.sample_rate_hz) +
                                " s that such a file holds",
                            "try --until, fewer bits or a lower --sample-rate");
    }
    if (s.file.error_number == 0 && (s.broken || closed != 0)) s.file.error_number = EIO;
    if (s.file.error_number != 0) return system_failure(s.path, "write", s.file.error_number);
    const int error_number = s.pending->commit();
    if (error_number != 0) return system_failure(s.path, "write", error_number);
    return {};
}

}  // namespace tribo::files
