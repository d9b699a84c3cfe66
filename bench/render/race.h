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
    std::size_t rows = 0;    ///< rows of hogels, spread over the hologram, of hogel's renderer in a round
    std::size_t rounds = 0;  ///< rounds for the medians
    double seconds = 0;      ///< time limit of a peer in a round; slower peers render fewer hogels
};

/// Speed of a renderer over all rounds. A sample is a ray with all its channels.
struct Racer {
    std::string name;
    double median = 0, min = 0, max = 0;  ///< million samples per second of wall time
    double per_processor_second = 0;      ///< million samples, median
    double bytes = 0;                     ///< maximum memory in bytes without the scene: samples, trees, buffers
    std::size_t hogels = 0;               ///< number of hogels in each round
    double ours_is_faster = 1;            ///< ratio of speeds, median over the rounds
    double differing = 0;                 ///< fraction of samples that differ from hogel's
};

struct Race {
    std::vector<Racer> racers;  ///< hogel's renderer first
    double covered = 0;         ///< fraction of rays that hit the scene
};

/// Measures hogel's renderer and peers on the same rays of the same triangles. They alternate round by round, so that
/// other work on the machine affects all alike. Peers that are missing on this machine are reported and left out.
/// Throws Error(internal) if a peer renders a different picture.
Race race(const Session& session, const std::string& algorithm, const std::vector<RenderPeerInfo>& peers,
          const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid, const RaceLimits& limits);

}  // namespace hogel::bench
