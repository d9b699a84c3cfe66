// SPDX-License-Identifier: Apache-2.0
#include "bench/peers/renderers.h"

namespace hogel::bench {

const std::vector<RenderPeerInfo>& render_peers() {
    static const std::vector<RenderPeerInfo> all{
        {"embree-stream",
         [](const ShadedScene& scene, const LightFieldGrid& grid) { return make_embree_peer(scene, grid, 16); }},
        {"embree-packet",
         [](const ShadedScene& scene, const LightFieldGrid& grid) { return make_embree_peer(scene, grid, 4); }},
        {"llvmpipe",
         [](const ShadedScene& scene, const LightFieldGrid& grid) { return make_llvmpipe_peer(scene, grid, 1); }},
        {"llvmpipe-16",
         [](const ShadedScene& scene, const LightFieldGrid& grid) { return make_llvmpipe_peer(scene, grid, 16); }},
    };
    return all;
}

}  // namespace hogel::bench
