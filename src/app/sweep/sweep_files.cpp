// SPDX-License-Identifier: MIT
#include "app/sweep/sweep_files.hpp"

#include <array>
#include <openssl/sha.h>

namespace tribo::app {

std::string digest_of(std::string_view text) {
    std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
    SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), hash.data());
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string digest;
    for (std::size_t n = 0; n < hash.size() / 2; ++n) {
        digest += kDigits[hash[n] >> 4];
        digest += kDigits[hash[n] & 15];
    }
    return digest;
}

void SweepFiles::use(const std::string& path, std::string_view bytes) const {
    const auto [known, is_new] = digests_.try_emplace(path);
    if (is_new) known->second = digest_of(bytes);
    used_.insert(*known);
}

std::string SweepFiles::digest() const {
    std::string all;
    for (const auto& [path, digest] : used_) all += digest + '\n';
    return digest_of(all);
}

FileResult<std::string> SweepFiles::read(const std::string& path, std::uint64_t limit_bytes) const {
    auto kept = texts_.find(path);
    if (kept == texts_.end()) {
        auto text = disk_.read(path, limit_bytes);
        if (!text) return text;
        kept = texts_.emplace(path, *std::move(text)).first;
    }
    use(path, kept->second);
    return kept->second;
}

FileResult<readers::Model> SweepFiles::read_model(const readers::ModelFile& file) const {
    const std::pair key{file.path, file.unit_mm.value_or(0)};
    auto kept = models_.find(key);
    if (kept == models_.end()) {
        // The bytes first: the model has no more of the file than its triangles.
        auto bytes = disk_.read(file.path, files::kLargestInputBytes);
        if (!bytes) return std::unexpected(bytes.error());
        auto model = disk_.read_model(file);
        if (!model) return model;
        use(file.path, *bytes);
        kept = models_.emplace(key, *std::move(model)).first;
    } else {
        use(file.path, {});
    }
    if (kept->second.mesh.triangles.size() > file.max_triangles) return disk_.read_model(file);
    return kept->second;
}

FileResult<job::StockSource> SweepFiles::stock_source(const std::string& path) const {
    return disk_.stock_source(path);
}

}  // namespace tribo::app
