// SPDX-License-Identifier: Apache-2.0
#include "hogel/codec/encode/chained_hogels.h"

#include <algorithm>
#include <cmath>

#include "hogel/codec/decode/hogel_decoder.h"
#include "hogel/codec/format/bytes.h"
#include "hogel/codec/format/pictures.h"
#include "hogel/core/parallel.h"

namespace hogel::codec::encode {

using namespace format;

void decode_chained_hogels(std::span<const std::uint8_t> bytes, const LightFieldGrid& grid, LightFieldTile& tile) {
    ByteReader header(bytes, "tile");
    if (!decode::hogel_tile_fits(grid, tile.range)) header.damaged("it is too large");
    const float step = header.take_float(), growth = header.take_float();
    if (!(step > 0 && std::isfinite(step) && growth >= 1 && growth <= 4)) header.damaged("its steps are no steps");
    const TileSetup setup(HogelOrder(tile.range.ns, tile.range.nt, HogelOrder::all_of_a_side, HogelOrder::all_of_a_side,
                                     HogelOrder::Begin::corners),
                          grid.directions_u, grid.directions_v, grid.channels, step, growth,
                          static_cast<float>(grid.step_u() / grid.step_v()), 1);
    const auto& order = setup.order.hogels();
    std::vector<CodedHogel> coded(order.size());
    std::vector<Picture> pictures(order.size());
    BlockReader reader(header.take(header.left()));
    const auto models = std::make_unique<BlockModels>();
    for (std::size_t wave = 0; wave + 1 < setup.order.waves().size(); ++wave) {
        const std::size_t begin = setup.order.waves()[wave], end = setup.order.waves()[wave + 1];
        std::vector<std::vector<const Block*>> moved(end - begin);
        core::parallel_for(end - begin, [&](std::size_t n) {
            moved[n] = moved_blocks(order[begin + n], coded, setup.grid, setup.aspect);
        });
        for (std::size_t k = begin; k < end; ++k) {
            const auto& tellers = order[k].tellers;
            code_hogel(reader, *models, setup.grid, order[k], moved[k - begin],
                       tellers.empty() ? nullptr : &coded[tellers.front().hogel].blocks, coded[k]);
        }
        if (reader.ended()) header.damaged("it ends too early");
        core::parallel_for(end - begin, [&](std::size_t n) {
            const std::size_t k = begin + n;
            std::vector<BlockState> blocks(setup.grid.count(), BlockState::wanted);
            reconstruct(setup, k, coded[k], blocks, pictures);
            coded[k].levels = {};
            for_each_row(pictures[k], setup, [&](std::size_t c, std::size_t v, std::span<const float> row) {
                std::ranges::copy(row, &tile.radiance(c, order[k].t, order[k].s, v, 0));
            });
        });
    }
    if (!reader.all_read()) header.damaged("bytes are left over");
}

}  // namespace hogel::codec::encode
