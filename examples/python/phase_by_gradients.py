# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A phase found by gradients
#
# A pattern of phases that shows a picture 20 mm behind it. Light goes forwards by `propagate()`, errors come back by its
# adjoint, `propagate_adjoint()`: that is all a gradient needs.

# %%
import hogel
import numpy as np
from hogel import mm, nm, um

pitch, wavelength, distance, side = 8 * um, 532 * nm, 20 * mm, 256

# The target: a light field's photograph, in the middle of the plane.
shown = np.asarray(hogel.Scene.load("pumpkin").render(hogels=160, directions=8, size=8 * mm).views()).mean(axis=2)
target = np.zeros((side, side), np.float32)
target[48:208, 48:208] = np.sqrt(np.clip(shown / np.quantile(shown, 0.995), 0, 1))
weight = np.zeros((side, side), np.float32)
weight[40:216, 40:216] = 1  # what falls beside the picture does not count

# %% [markdown]
# The error of the amplitudes, and its derivative by each phase.

# %%
def amplitudes(phase):
    wave = hogel.Field.from_array(np.exp(1j * phase).astype(np.complex64), pitch=pitch, wavelength=wavelength)
    return wave, wave.propagate(distance)


def gradient(phase):
    """The mean squared error of the amplitude, up to the best factor, and its derivative by each phase."""
    wave, far = amplitudes(phase)
    values = np.asarray(far)
    size = np.abs(values)
    scale = (weight * size * target).sum() / (weight * target**2).sum()
    error = weight * (size - scale * target)
    # d|F| = Re(conj(F)/|F| dF), and dF = P(i e^{i phase} d phase).
    back = hogel.Field.from_array((error * values / np.maximum(size, 1e-9)).astype(np.complex64), pitch=pitch, wavelength=wavelength)
    slope = np.imag(np.conj(np.asarray(wave)) * np.asarray(back.propagate_adjoint(distance)))
    return (error**2).sum() / (weight * size**2).sum(), slope

# %% [markdown]
# Adam, in a few lines.

# %%
first = np.random.default_rng(1).uniform(-np.pi, np.pi, (side, side))
phase = first.copy()
before = np.abs(np.asarray(amplitudes(phase)[1]))
mean, square = np.zeros_like(phase), np.zeros_like(phase)
for step in range(1, 121):
    loss, slope = gradient(phase)
    mean, square = 0.9 * mean + 0.1 * slope, 0.99 * square + 0.01 * slope**2
    phase -= 0.12 * (mean / (1 - 0.9**step)) / (np.sqrt(square / (1 - 0.99**step)) + 1e-8)
    if step == 1 or step % 40 == 0:
        print(f"step {step}: error {100 * loss:.2f} % of the light")
assert loss < 0.03, loss

# %% [markdown]
# Where torch is installed, `hogel.autograd.propagate()` does the same inside torch: any loss, any optimiser. Its gradient at
# the first phase is the one above.

# %%
try:
    import torch

    import hogel.autograd

    def loss_of(phase):
        far = hogel.autograd.propagate(torch.exp(1j * phase), pitch=pitch, wavelength=wavelength, distance=distance).abs()
        where, wanted = torch.from_numpy(weight), torch.from_numpy(target)
        scale = ((where * far * wanted).sum() / (where * wanted**2).sum()).detach()
        return (where * (far - scale * wanted) ** 2).sum()

    tensor = torch.from_numpy(first.astype(np.float32)).requires_grad_()
    loss_of(tensor).backward()
    ours = 2 * gradient(first)[1]
    apart = np.linalg.norm(tensor.grad.numpy() - ours) / np.linalg.norm(ours)
    assert apart < 1e-3, apart
    optimiser = torch.optim.Adam([tensor], lr=0.12)
    begin = float(loss_of(tensor))
    for step in range(20):
        optimiser.zero_grad()
        value = loss_of(tensor)
        value.backward()
        optimiser.step()
    assert value < 0.2 * begin
    print(f"torch: the gradient differs by {apart:.1e}; 20 steps of its Adam take the error to {float(value) / begin:.2f} of what it was")
except ImportError:
    print("torch is not installed")

# %% [markdown]
# The target, what the first and the last phase show, and the phase.

# %%
after = np.abs(np.asarray(amplitudes(phase)[1]))


def bright(values):
    inside = values[40:216, 40:216]
    return (values / np.quantile(inside, 0.995)) ** 2


panels = [target**2, bright(before), bright(after), (np.mod(phase, 2 * np.pi) / (2 * np.pi)) ** 2.2]
hogel.Picture(np.concatenate(panels, axis=1)).save("phase.png", exposure=1)
# phase.png: a pumpkin; noise; the same pumpkin in noise around it; the phase
