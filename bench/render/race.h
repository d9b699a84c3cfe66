// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/renderers.h"
#include "bench/session.h"
#include "hogel/shading.h"

namespace hogel::bench {

struct RaceLimits {
    std::size_t rows = 0;    ///< of hogels, spread over the hologram, that our renderer renders in a round
    std::size_t rounds = 0;  ///< of which medians are taken
    double seconds = 0;      ///< that a peer may take in a round; a slower one gets fewer of the hogels
};

/// How fast a renderer was over all rounds. A sample is a ray with all its channels.
struct Racer {
    std::string name;
    double median = 0, min = 0, max = 0;  ///< million samples a second of wall time
    double per_processor_second = 0;      ///< million samples, median
    double bytes = 0;                     ///< the most memory held, beyond the scene: samples, trees, buffers
    std::size_t hogels = 0;               ///< in each round
    double ours_is_faster = 1;            ///< how many times, median over the rounds
    double differing = 0;                 ///< share of samples that differ from ours
};

struct Race {
    std::vector<Racer> racers;  ///< ours first
    double covered = 0;         ///< share of rays that meet something
};

/// Our renderer and peers on the same rays of the same triangles. They take turns round by round, so that other work on
/// the machine disturbs all alike. Peers that this machine lacks are left out, which is said. Throws Error(internal) if
/// a peer renders another picture.
Race race(const Session& session, const std::string& algorithm, const std::vector<RenderPeerInfo>& peers,
          const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid, const RaceLimits& limits);

}  // namespace hogel::bench
