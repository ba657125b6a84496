/// OpenGL 4.5 core, linked directly: the software GL library exports every entry point.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
