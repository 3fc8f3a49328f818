// SPDX-License-Identifier: MIT
#include "files/sound/sound_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <sndfile.h>

#include "base/text/decimal.hpp"

namespace tribo::files {
namespace {

// Bytes in memory as a file for libsndfile.
struct Memory {
    std::string_view bytes;
    sf_count_t at = 0;

    static sf_count_t length(void* self) {
        return static_cast<sf_count_t>(static_cast<Memory*>(self)->bytes.size());
    }
    static sf_count_t seek(sf_count_t offset, int whence, void* self) {
        auto& m = *static_cast<Memory*>(self);
        const sf_count_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? m.at : length(self);
        if (offset < -from || offset > length(self) - from) return -1;
        return m.at = from + offset;
    }
    static sf_count_t read(void* to, sf_count_t count, void* self) {
        auto& m = *static_cast<Memory*>(self);
        const sf_count_t n = std::clamp<sf_count_t>(count, 0, length(self) - m.at);
        std::memcpy(to, m.bytes.data() + m.at, static_cast<std::size_t>(n));
        m.at += n;
        return n;
    }
    static sf_count_t write(const void*, sf_count_t, void*) { return 0; }
    static sf_count_t tell(void* self) { return static_cast<Memory*>(self)->at; }
};

struct Closer {
    void operator()(SNDFILE* file) const { ::sf_close(file); }
};

int bits_of(int format) {
    switch (format & SF_FORMAT_SUBMASK) {
        case SF_FORMAT_PCM_S8:
        case SF_FORMAT_PCM_U8:
            return 8;
        case SF_FORMAT_PCM_16:
            return 16;
        case SF_FORMAT_PCM_24:
            return 24;
        case SF_FORMAT_PCM_32:
            return 32;
        default:
            return 0;
    }
}

bool is_known(int format) {
    const int container = format & SF_FORMAT_TYPEMASK;
    return container == SF_FORMAT_WAV || container == SF_FORMAT_WAVEX || container == SF_FORMAT_RF64 ||
           container == SF_FORMAT_W64 || container == SF_FORMAT_FLAC;
}

// True when the log of libsndfile says that the data chunk is truncated.
bool cut_short(SNDFILE* file) {
    std::array<char, 4096> log{};
    ::sf_command(file, SFC_GET_LOG_INFO, log.data(), static_cast<int>(log.size()) - 1);
    const std::string_view text(log.data());
    const std::size_t data = text.find("data : ");
    const std::size_t line_end = text.find('\n', data == text.npos ? 0 : data);
    return data != text.npos && text.substr(data, line_end - data).find("should be") != text.npos;
}

}  // namespace

Result<SoundFile> parse_sound(std::string_view bytes, const std::string& source_name) {
    const auto refuse = [&](std::string cause, std::string remedy) {
        return fail_at(source_name, 0, 0, std::move(cause), std::move(remedy));
    };
    if (bytes.empty()) return refuse("is empty", "give a WAV or FLAC file");
    const bool wave = bytes.starts_with("RIFF") || bytes.starts_with("RF64") || bytes.starts_with("riff") ||
                      bytes.starts_with("RIFX");
    if (!wave && !bytes.starts_with("fLaC")) {
        return refuse("is neither WAV nor FLAC", "convert the recording, for example with sox");
    }
    Memory memory{bytes};
    SF_VIRTUAL_IO io{Memory::length, Memory::seek, Memory::read, Memory::write, Memory::tell};
    SF_INFO info{};
    const std::unique_ptr<SNDFILE, Closer> file(::sf_open_virtual(&io, SFM_READ, &info, &memory));
    if (!file || !is_known(info.format)) {
        const std::string what = file ? "of an unknown kind" : ::sf_strerror(nullptr);
        return refuse("cannot be read as sound (" + what + ")", "convert the recording to plain WAV");
    }
    if (info.samplerate < kLeastSoundHz || info.samplerate > kMostSoundHz) {
        return refuse(
            "has a sample rate of " + std::to_string(info.samplerate) + " Hz",
            "give one from " + format_decimal(kLeastSoundHz) + " to " + format_decimal(kMostSoundHz));
    }
    if (info.channels < 1 || info.channels > 64) {
        return refuse("has " + std::to_string(info.channels) + " channels", "give 1 to 64");
    }
    SoundFile sound;
    sound.sample_rate_hz = info.samplerate;
    sound.channels = info.channels;
    sound.bits = bits_of(info.format);
    // The header may be wrong: memory is allocated only for samples that are read.
    const auto channels = static_cast<std::size_t>(info.channels);
    std::vector<double> block(4096 * channels), energy(channels);
    std::vector<std::vector<double>> all(channels);
    while (true) {
        const sf_count_t frames = ::sf_readf_double(file.get(), block.data(), 4096);
        if (frames <= 0) break;
        if (static_cast<std::int64_t>((all[0].size() + static_cast<std::size_t>(frames)) * channels) >
            kMostSoundSamples) {
            return refuse("is longer than " + std::to_string(kMostSoundSamples / info.samplerate / 60) +
                              " minutes of one channel",
                          "cut out the stretch in which the material is rubbed");
        }
        for (std::size_t n = 0; n < static_cast<std::size_t>(frames) * channels; ++n) {
            const double v = block[n];
            if (!std::isfinite(v)) return refuse("holds samples that are no numbers", "convert it anew");
            energy[n % channels] += v * v;
            all[n % channels].push_back(v);
        }
    }
    if (all[0].empty()) return refuse("holds no sound", "give a recording of friction");
    if (static_cast<std::int64_t>(all[0].size()) < info.frames || cut_short(file.get())) {
        sound.warnings.push_back(
            {source_name, 0, "the file ends before its header says; read as far as it goes"});
    }
    const auto loudest = std::ranges::max_element(energy) - energy.begin();
    sound.samples = std::move(all[static_cast<std::size_t>(loudest)]);
    if (channels > 1) {
        sound.warnings.push_back(
            {source_name, 0, "of " + std::to_string(channels) + " channels the loudest is taken"});
    }
    return sound;
}

FileResult<SoundFile> read_sound(const std::string& path) {
    const FileResult<std::string> bytes = read_file(path);
    if (!bytes) return std::unexpected(bytes.error());
    Result<SoundFile> sound = parse_sound(*bytes, path);
    if (!sound) return std::unexpected(FileFailure(sound.error()));
    return *std::move(sound);
}

}  // namespace tribo::files
