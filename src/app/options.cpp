// SPDX-License-Identifier: MIT
#include "app/options.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text/limit_text.hpp"
#include "base/text/nearest.hpp"
#include "base/text/printable.hpp"

namespace tribo::app {
namespace {

// The verb that was being parsed; the program itself if there was none.
const CLI::App& deepest(const CLI::App& program) {
    const std::vector<CLI::App*> verbs = program.get_subcommands();
    return verbs.empty() ? program : *verbs.front();
}

std::vector<std::string> known_words(const CLI::App& app, bool flag) {
    std::vector<std::string> words;
    if (flag) {
        for (const CLI::Option* option : app.get_options()) {
            for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
            for (const std::string& name : option->get_snames()) words.push_back("-" + name);
        }
    } else {
        for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
            words.push_back(verb->get_name());
        }
    }
    return words;
}

}  // namespace

CLI::Validator within(const Limit& limit) {
    const auto check = [&limit](std::string& text) -> std::string {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value)) {
            return "'" + text + "' is not a number";
        }
        if (limit.range.contains(value)) return "";
        return out_of_range(limit, value) + "; " + range_remedy(limit);
    };
    return CLI::Validator(check, "");
}

CLI::Validator one_of(std::vector<std::string_view> words) {
    const auto check = [words](std::string& text) -> std::string {
        if (std::find(words.begin(), words.end(), text) != words.end()) return "";
        return "'" + text + "' is unknown; " + suggestion(text, words);
    };
    return CLI::Validator(check, "");
}

std::string explain_usage(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App& app = deepest(program);
    const std::string help =
        "see '" + std::string(&app == &program ? "tribo" : "tribo " + app.get_name()) + " --help'";
    const std::vector<std::string> extras = program.remaining(true);
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError) && !extras.empty()) {
        const std::string& unknown = extras.front();
        const bool flag = unknown.starts_with("-");
        const std::string bare = unknown.substr(0, unknown.find('='));
        const std::vector<std::string> known = known_words(app, flag);
        const std::vector<std::string_view> views(known.begin(), known.end());
        if (views.empty()) return printable("error: '" + unknown + "' is one argument too many; " + help);
        return printable(std::string("error: unknown ") + (flag ? "option" : "verb") + " '" + bare + "'; " +
                         suggestion(bare, views));
    }
    return printable(std::string("error: ") + error.what() + "; " + help);
}

}  // namespace tribo::app
