// SPDX-License-Identifier: MIT
// `tribo devices`: lists arms and sound cards, with the reasons why an arm is missing.
#include <CLI/App.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/exit.hpp"
#include "app/verbs/verbs.hpp"
#include "devices/arm/device_search.hpp"
#include "files/json/json.hpp"

namespace tribo::app {
namespace {

namespace fs = std::filesystem;

// Returns the playback devices of the kernel; empty: none.
std::vector<std::string> playing_cards() {
    std::vector<std::string> cards;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator("/dev/snd", error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("pcm") && name.ends_with("p")) cards.push_back(entry.path().string());
    }
    return cards;
}

constexpr const char* kNoCard = "no sound card plays: /dev/snd holds no pcm*p";
constexpr const char* kCardRemedy = "plug one in, or listen to sound.wav of 'tribo render' elsewhere";

void print_json(const std::vector<devices::ArmReport>& arms, const std::vector<std::string>& cards) {
    files::Json json;
    json["schema"] = "tribo.devices/1";
    json["haptic"] = files::Json::array();
    for (const devices::ArmReport& a : arms) {
        files::Json arm;
        arm["name"] = a.name;
        arm["makes"] = a.makes;
        arm["available"] = a.available;
        if (a.available) {
            arm["model"] = a.model;
            files::set(arm, "max_force_n", a.limits.max_force_n);
            files::set(arm, "max_stiffness_n_per_mm", a.limits.max_stiffness_n_per_mm);
        } else {
            arm["problem"] = a.problem;
            arm["remedy"] = a.remedy;
            if (!a.ports.empty()) arm["ports"] = a.ports;
        }
        json["haptic"].push_back(std::move(arm));
    }
    for (const char* name : {"simulated", "playback"})
        json["haptic"].push_back({{"name", name}, {"available", true}});
    files::Json audio;
    audio["available"] = !cards.empty();
    if (cards.empty()) {
        audio["problem"] = kNoCard;
        audio["remedy"] = kCardRemedy;
    } else {
        audio["ports"] = cards;
    }
    json["audio"] = std::move(audio);
    std::printf("%s", files::pretty(json).c_str());
}

void print_text(const std::vector<devices::ArmReport>& arms, const std::vector<std::string>& cards) {
    for (const devices::ArmReport& a : arms) {
        if (a.available) {
            std::printf("%-16s %s: %g N, %g N/mm\n", a.name.c_str(), a.model.c_str(), a.limits.max_force_n,
                        a.limits.max_stiffness_n_per_mm);
            continue;
        }
        std::printf("%-16s not there (%s)\n", a.name.c_str(), a.makes.c_str());
        std::printf("%16s   %s\n%16s   %s\n", "", a.problem.c_str(), "", a.remedy.c_str());
        for (const std::string& port : a.ports) std::printf("%16s   %s\n", "", port.c_str());
    }
    std::printf("%-16s a hand that yields\n%-16s exactly on a stroke\n", "simulated", "playback");
    if (cards.empty()) {
        std::printf("%-16s %s\n%16s   %s\n", "sound", kNoCard, "", kCardRemedy);
    } else {
        for (const std::string& card : cards) std::printf("%-16s %s\n", "sound", card.c_str());
    }
}

}  // namespace

void add_devices(CLI::App& program, int& exit_code) {
    const auto json = std::make_shared<bool>(false);
    CLI::App* verb = program.add_subcommand("devices", "Haptic arms and sound cards, and why one is missing");
    verb->add_flag("--json", *json, "For machines");
    verb->callback([json, &exit_code] {
        const auto arms = devices::search_arms();
        const auto cards = playing_cards();
        (*json ? print_json : print_text)(arms, cards);
        exit_code = kDone;
    });
}

}  // namespace tribo::app
