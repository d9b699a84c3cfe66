// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>

#include "view/subject.h"
#include "view/waves.h"

namespace hogel::view {

/// A light field that is looked at: its samples in memory, in the order that eyes want them.
class LightFieldSubject final : public Subject {
  public:
    /// Reads `shown`, which is `light_field` or some hogels of it; readings come from `light_field` itself.
    /// @param waves  those of its holograms; none of a first look
    LightFieldSubject(LightField light_field, LightField shown, std::size_t memory, const Progress& progress,
                      std::unique_ptr<Waves> waves = {});

    const LightFieldGrid& grid() const { return light_field_.grid(); }
    const LightFieldGrid& shown() const { return shown_; }

    double width() const override { return grid().width(); }
    double height() const override { return grid().height(); }
    bool has_rays() const override { return true; }
    std::size_t looks() const override { return waves_ ? waves_->looks() : 0; }
    nlohmann::ordered_json facts() const override;
    double exposure() const override { return exposure_; }
    Reading read(const View& view, const Spot& spot) const override;
    /// As the light field knows it, otherwise where a few pixels around the spot are sharpest.
    double focus(const View& view, const Spot& spot, const Progress& progress) override;
    /// hogel: the directions of one hogel. views: the light field from directions across and down. s-u, t-v: the
    /// epipolar planes through the spot, which run along a row or a column of hogels. depth: near is bright.
    Photograph inside(const View& view, const Spot& spot, const Inside& inside, const Progress& progress) override;

  protected:
    Image by_rays(const View& view, const Progress& progress) override;
    void by_waves(const View& view, std::size_t looks, const ShownLooks& shown, const Progress& progress) override;

  private:
    double sharpest(const View& view, const Spot& spot, const Progress& progress);
    Image views(const Inside& inside, const Progress& progress);

    LightField light_field_;
    LightFieldGrid shown_;
    std::mutex photographing_;  // rays, which are beside waves too
    RayPhotographer photographer_;
    std::unique_ptr<Waves> waves_;
    double exposure_ = 1;
};

/// The step between hogels at which a light field's samples fit into `memory` as halves.
std::size_t step_that_fits(const LightFieldGrid& grid, std::size_t memory);
/// The step for a first look, which is read in a moment; 1 where the whole is.
std::size_t step_of_first_look(const LightFieldGrid& grid);

}  // namespace hogel::view
