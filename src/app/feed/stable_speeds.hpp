// SPDX-License-Identifier: MIT
// Writes spindle speeds at which the tools of a program do not chatter, and the feeds that keep its chips.
#pragma once

#include <string>

#include "app/feed/feed_outputs.hpp"
#include "app/render/render_job.hpp"
#include "base/parallel.hpp"
#include "readers/rewrite/feed_words.hpp"

namespace tribo::app {

// Replaces text and setup of the loaded job where a tool should have another speed; the speeds are in the
// answer. Refuses a job in which nothing bends, and tools that share a speed word.
FileResult<void> use_stable_speeds(const FeedCall& call, readers::FeedLanguage language,
                                   const ParallelFor& parallel, PreparedJob& loaded, std::string& text,
                                   FeedAnswer& answer);

}  // namespace tribo::app
