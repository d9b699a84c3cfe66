% SPDX-License-Identifier: Apache-2.0
% Reads with GNU Octave what hogel wrote, by docs/files.md and docs/exchange.md: run in the folder of exchange_octave.txt.
radiance = double (load ('hci.h5').radiance);
printf ('direction direction s t channel:%s\n', sprintf (' %d', size (radiance)));
% The camera in the middle row and the last column, from the left, is what an eye on the right sees: the first U.
codes = double (imread ('out/input_Cam005.png')) / 255;
light = codes / 12.92;
light(codes > 0.04045) = ((codes(codes > 0.04045) + 0.055) / 1.055) .^ 2.4;
view = permute (squeeze (radiance(1, 2, :, :, :)), [2 1 3]);
printf ('input_Cam005.png is column 1 and row 2 of the directions: %d\n', max (abs (view(:) - light(:))) < 1e-3);
% The array of a MAT file: row and column of views, y, x, channel.
LF = load ('out.mat').LF;
printf ('size of LF:%s, %s\n', sprintf (' %d', size (LF)), class (LF));
printf ('LF(2,3,...) is input_Cam005.png: %d\n', isequal (squeeze (LF(2, 3, :, :, :)), imread ('out/input_Cam005.png')));
save ('-v7', 'octave.mat', 'LF');
LF = permute (double (LF), [3 4 1 2 5]);
save ('-v6', 'turned.mat', 'LF');
