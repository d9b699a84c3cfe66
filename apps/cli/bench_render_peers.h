// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hogel/shading.h"
#include "render_peers.h"
#include "session.h"

namespace hogel::cli {

struct RaceLimits {
    std::size_t rows = 0;    ///< of hogels that the renderer is given, spread over the hologram
    std::size_t rounds = 0;  ///< of which medians are taken
    double seconds = 0;      ///< that a peer may take in a round: it gets fewer of the rows' hogels if all take longer
};

/// How fast somebody was over all rounds.
struct Racer {
    std::string name;
    double median = 0, least = 0, most = 0;  ///< million samples a second of wall time, all channels of a ray are one
    double per_processor_second = 0;         ///< median
    double bytes = 0;                        ///< the most memory held, beyond the scene: samples, trees, buffers
    std::size_t hogels = 0;                  ///< in each round
    double renderer_is_faster = 1;           ///< median over the rounds of how many times
    double differing = 0;                    ///< share of samples that are not the renderer's, by more than 1/64
};

/// A renderer and peers on the same rays of the same triangles, taking turns round by round, so that whatever else
/// runs on the machine disturbs all alike. The renderer comes first; it renders whole rows in the tiles that it
/// prefers. Peers that this machine lacks are left out and said. Throws Error(internal) if a peer sees another picture.
struct Race {
    std::vector<Racer> racers;
    double covered = 0;  ///< share of rays that meet something
};
Race race(const Session& session, const std::string& algorithm, const std::vector<RenderPeerInfo>& peers,
          const std::shared_ptr<const ShadedScene>& scene, const LightFieldGrid& grid, const RaceLimits& limits);

}  // namespace hogel::cli
