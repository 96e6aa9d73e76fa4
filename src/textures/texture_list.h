// The list of textures. To add one: its header, and its name in the list.
#pragma once

#include "textures/bilerp.h"
#include "textures/checkerboard.h"
#include "textures/constant.h"
#include "textures/direction_mix.h"
#include "textures/dots.h"
#include "textures/fbm.h"
#include "textures/imagemap.h"
#include "textures/marble.h"
#include "textures/mix.h"
#include "textures/scale.h"
#include "textures/windy.h"
#include "textures/wrinkled.h"

namespace etd {

using Textures =
    TypeList<ConstantTexture, ScaleTexture, MixTexture, DirectionMixTexture, BilerpTexture, ImageMapTexture,
             CheckerboardTexture, DotsTexture, FbmTexture, WrinkledTexture, WindyTexture, MarbleTexture>;

template <class T>
Texture::Texture(const T& texture) {
  storage_.store<Textures>(texture);
}

}  // namespace etd
