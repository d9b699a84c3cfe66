// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hogel/export.h"
#include "hogel/pipeline.h"
#include "hogel/progress.h"
#include "hogel/scene.h"
#include "hogel/scenes.h"

namespace hogel {

/// A scene before it is placed at a hologram, for programs that place and light it again and again: a mesh file is read
/// once, and a built-in scene is made again only for another size. For one thread at a time.
class HOGEL_API SceneModel {
  public:
    /// Reads a mesh file. Throws as load_scene() does.
    explicit SceneModel(std::string name, const ImportOptions& options = {}, const Progress& progress = {});

    /// Whether it comes from a mesh file, so that LightFieldRequest::fit and LightFieldRequest::front act.
    bool is_file() const { return imported_.has_value(); }
    /// The scene of load_scene() with this request, whose `import` is that of the constructor. Throws as that does.
    Scene placed(const LightFieldRequest& request, const Progress& progress = {});

  private:
    std::string name_;
    std::optional<Scene> imported_, made_;
    double made_for_ = 0;  // side of the hologram of `made_`, metres
};

/// A parameter whose value keeps a hologram from showing a scene as it could, and the value that would do.
struct Advice {
    std::string parameter;  ///< "pitch", "directions" or "hogels", as options of the command line
    std::string text;       ///< one sentence, with the numbers
    double enough = 0;      ///< what would do with the other parameters as they are: metres, or a number across
    bool refused = false;   ///< whether there is no such hologram at all; otherwise it is less sharp than its hogels
};

/// What of a scene a light field and its holograms cannot show with these parameters.
///
/// * pitch: samples of pitch p diffract the wavelength λ to sin θ = λ/(2p) at most; steeper rays would alias. The pitch
///   is rounded so that a hogel has a whole number of samples, and `enough` is a pitch that needs no rounding.
/// * directions: at depth ζ the rays of neighbouring directions are |ζ|ΔU apart. Where that is more than a hogel,
/// details
///   of a hogel's size are lost ([K] 2.3).
/// * hogels: a hogel of width d diffracts light of wavelength λ into λ/d, which at depth ζ is |ζ|λ/d wide. Where that
/// is
///   more than the hogel itself, fewer and larger hogels, √(λ|ζ|) wide, show it more sharply.
///
/// @param scene  as it is placed; its nearest and farthest depths count
HOGEL_API std::vector<Advice> advise(const Bounds& scene, const LightFieldRequest& light_field,
                                     const HologramRequest& hologram);

/// The pitch of a request, or where that does not diffract the field of view of the one face, the `enough` of advise(),
/// metres. The sides of a hemicube show what no pitch diffracts: of several faces it is the pitch of the request.
HOGEL_API double diffracting_pitch(std::span<const LightFieldGrid> faces, const HologramRequest& hologram);

}  // namespace hogel
