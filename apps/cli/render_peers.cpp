#include "render_peers.h"

namespace hogel::cli {

const std::vector<RenderPeerInfo>& render_peers() {
    using Scene = std::shared_ptr<const ShadedScene>;
    static const std::vector<RenderPeerInfo> all{
        {"embree-stream", [](Scene scene, const LightFieldGrid& grid) { return make_embree_peer(scene, grid, 16); }},
        {"embree-packet", [](Scene scene, const LightFieldGrid& grid) { return make_embree_peer(scene, grid, 4); }},
        {"llvmpipe", [](Scene scene, const LightFieldGrid& grid) { return make_llvmpipe_peer(scene, grid, 1); }},
        {"llvmpipe-16", [](Scene scene, const LightFieldGrid& grid) { return make_llvmpipe_peer(scene, grid, 16); }},
    };
    return all;
}

}  // namespace hogel::cli
