#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that a wrong value of an option is refused with status 2 and one line that names the option, also where it is
the library that finds out.

usage: check_options.py     in a folder with the files that options.txt makes; hogel in the PATH
"""
import subprocess

SMALL = "--hogels 6x4 --directions 8x6 --size 1mm"
PHOTO = "--eye 0,0,40mm --resolution 8"
MODULATOR = "--pixels 256x192 --pixel-pitch 6.4um"

# A command line, and wrong options that may end it, one at a time.
TABLE = [
    ("render sphere -o w.h5",
     """--algorithm=magic --shading=phong --shadow-map=0 --cache-spacing=17 --cache-spacing=nan --hogels=0
     --hogels=99999999 --directions=4x --samples=65 --size=0mm --size=1e300m --size=16 --fov=180deg --fov=20 --toward=89deg
     --front=2 --region=0 --frequencies=-1nm --frequencies=633nm --focal-plane=0mm --focal-plane=1e-320m --focal-plane=1nm --focal-plane=x --sqnr=30 --threads=-1 --seed=x"""),
    ("render sphere -o w.h5 --hogels 4", "--directions=16777216"),
    ("render sphere -o w.h5 --hemicube", "--directions=5 --fov=20deg"),
    ("render sphere -o w.h5 --shading shadowed", "--shadow-map=16777216"),
    ("render sphere -o w.hgl --hogels 4 --directions 4", "--sqnr=0 --sqnr=inf --float"),
    ("bake sphere -o w.glb", "--rays=0 --bounces=x --tessellate=0 --size=-1mm"),
    (f"hologram sphere -o w.h5 {SMALL}",
     """--wavelength=0nm --wavelength=rbg --pitch=0um --pitch=3um --line-pitch=-1um --line-pitch=10um
     --method=magic --phase=none --lobes=none --basis=wavy --tolerance=2 --spacing=0um --planes=0"""),
    ("hologram sphere -o w.h5 --hogels 4", "--directions=16777216"),
    (f"hologram sphere -o w.h5 {SMALL} --pitch 1.5um", "--fov=40deg"),
    (f"hologram sphere -o w.h5 {SMALL} --hemicube", "--method=olas --method=phase-added"),
    (f"hologram sphere -o w.h5 {SMALL} --method points", "--resume --cull-back-faces"),
    (f"slm s.h5 -o w.png {MODULATOR} --encoding bipolar", "--reference=-10deg --clip=2 --clip=nan --window=0 --iterations=x"),
    (f"slm s.h5 -o w.png {MODULATOR}", "--encoding=magic --levels=1 --levels=65537 --device=leto"),
    (f"slm s.h5 -o w.png {MODULATOR} --encoding gerchberg-saxton", "--window=1"),
    ("slm s.h5 -o w.png", "--device=zeus --device=pluto --pixels=8x8 --pixel-pitch=8um"),
    ("slm s.h5 -o w.png --pixels 8x8", "--pixel-pitch=0um --pixel-pitch=5um"),
    ("slm s.h5 -o w.png --pixel-pitch 6.4um", "--pixels=0 --pixels=99999x1"),
    ("photo f.h5 -o w.png",
     """--eye=0,0,0mm --eye=0,0 --eye=90,0,10mm --gaze=0,0,1m --focus=-1m --focus=1e300m --focus-tilt=90deg --pupil=0mm
     --pupil=1e-300m --f-number=0 --focal-length=0mm --angle-of-view=180deg --resolution=0
     --resolution=16777216x16777216 --to-eye=0,0,-1mm --to-focus=1mm --frames=0 --frames=2 --frame-rate=0 --looks=0
     --exposure=0 --exposure=inf --display=none --display=phase --camera=none --film-distance=1mm --pupil-samples=0
     --geometric --pitch=1um --values=phase --variable=a --conjugate"""),
    ("photo f.h5 -o w.png --camera full", "--film-distance=-1mm --film-distance=1um"),
    ("photo x.h5 -o w.png", "--focus-tilt=10deg --camera=full"),
    ("photo f.h5 -o w.png", "--focal=200mm --source=laser --fill-factor=0.5 --zero-order-stop=0.1 --device=zeus"),
    ("photo b.png -o w.png --focal 200mm",
     """--focal=0mm --source=lamp --source=led:520nm,30nm --source=sources:0,1mm --source=sources:9999,1mm --fill-factor=0 --fill-factor=2
     --zero-order-stop=-1 --aperture=0.6 --order=0.7,0 --focus=100m --eye=0,0,40mm --camera=full --looks=2 --display=phase --device=leto"""),
    ("photo f.h5 -o w.png --camera full --display phase", "--resume"),
    (f"photo sphere -o w.png {PHOTO} {SMALL}", "--pupil=20mm --pitch=3um --eye=30,0,40mm"),
    ("focus f.h5", "--region=0 --region=x --colour=0 --colour=2 --planes=3 --from=1mm --values=phase"),
    ("propagate f.h5 -o w.h5 --distance 1mm", "--imaginary=b.exr --variable=a --conjugate --pitch=1um --pitch=0um"),
    ("propagate f.h5 -o w.png", "--distance=1 --distance=1e300m"),
    ("propagate f.h5 -o w.png --distance 1mm",
     "--display=none --output-pitch=0mm --output-pitch=1 --output-samples=0 --offset-x=1 --offset-y=1e300m --offset-x=900mm"),
    ("make sphere -o w",
     """--eye-distance=0mm --eye-distance=50mm --pupil=0mm --resolution=0 --looks=x --pupil-samples=0 --pitch=3um"""),
    ("make sphere -o w --pitch 1.5um", "--fov=60deg"),
    ("compress x.h5 -o w.hgl",
     """--sqnr=0 --sqnr=130 --ppb=0 --ppb=0.001 --step=-1 --max-error=0 --coder=zip --transform=wavy
     --transform=haar --table=jpeg --symbols=words --symbols=alphabets --rule=histogram --overhead=2 --hemicube=none --depth-error=-1um --depth-error=1e-300m
     --tone=none-such --tone-decades=1 --chrominance=2000 --tile=x"""),
    ("compress x.h5 -o w.hgl --tone histogram", "--tone-decades=30"),
    ("compress x.h5 -o w.hgl --ppb 1", "--rule=none --rule=histogram --rule=planes --overhead=2"),
    ("compress x.h5 -o w.hgl --coder threepass --ppb 1", "--rule=none --overhead=2"),
    ("compress x.h5 -o w.hgl --coder threepass --ppb 1 --rule histogram", "--overhead=-1 --overhead=33 --overhead=nan"),
    ("compress x.h5 -o w.hgl --coder ezw --ppb 1", "--rule=histogram --symbols=bits"),
    ("compress x.h5 -o w.hgl --lossless", "--tone=histogram --chrominance=2"),
    ("compress x.h5 -o w.hgl --coder ezw", "--lossless --max-error=1"),
    ("compress x.h5 -o w.hgl --no-depth", "--depth-error=1mm"),
    ("decompress x.hgl -o w.h5", "--layers=0 --layers=99"),
    ("import views -o w.h5 --views 8x6",
     """--layout=zoo --size=0mm --size=4 --distance=1mm --spacing=1mm --fov=0deg --fov=200deg --transfer=x --views=3x3
     --column=third --mirror=all --projection=fish --disparity=1 --sqnr=30"""),
    ("import views -o w.h5 --views 8x6 --projection cameras", "--disparity=9 --distance=0mm"),
    ("import views -o w.hgl --views 8x6", "--float --sqnr=0"),
    ("export x.h5 -o w", "--layout=hci --layout=zoo --layout=quilt --pictures=gif --bits=7 --bits=17 --transfer=x --exposure=0"),
    ("export x.h5 -o w --pictures exr", "--bits=8"),
    ("view x.h5 --no-browser", "--port=70000 --port=x --host=0.0.0.0 --token=short --token=with/slash/0123456789 --memory=0 --memory=x"),
    ("print x.h5 -o w", "--exposure=0 --exposure=nan --order=none --bits=12 --dose=1 --dose=1,1,-1 --table=none --mirror=x"),
    ("compare x.h5 x.hgl", "--min-psnr=x --min-sqnr=nan"),
]

for line, options in TABLE:
    for option in options.split():
        name = option.split("=")[0]
        done = subprocess.run(["hogel", *line.split(), option], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              timeout=120)
        said = done.stderr.splitlines()
        # What is said of progress may come before.
        if done.returncode != 2 or not said or not said[-1].startswith("hogel: ") or name not in said[-1] or done.stdout:
            print(f"hogel {line} {option}\n  status {done.returncode}: {done.stderr}{done.stdout}")
print(sum(len(options.split()) for _, options in TABLE), "options")
