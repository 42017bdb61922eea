#include "support/host_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { BALLS = 300 };

const int host_rectangle[4] = {45, 40, 70, 50};

mns_field *host_cloud(void)
{
    static double position[3 * BALLS];
    uint64_t random = 21;
    for (size_t i = 0; i < 3 * (size_t)BALLS; i++) position[i] = draw_random(&random);
    return draw_field(BALLS, position, NULL, 0.14, NULL, MNS_KERNEL_POLY3);
}

mns_view host_view(void)
{
    return draw_view((const double[3]){0.5, 0.8, 2.4}, (const double[3]){0.5, 0.5, 0.5}, 40, VIEW_WIDE,
                     VIEW_HIGH);
}

/* ---- A host ---- */

host host_make(draw_fixture *d, bool stencil)
{
    const GladGLContext *gl = &d->gl.gl;
    host h = {0};
    gl->GenTextures(1, &h.color);
    gl->BindTexture(GL_TEXTURE_2D, h.color);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, HOST_WIDE, HOST_HIGH);
    gl->GenTextures(1, &h.depth);
    gl->BindTexture(GL_TEXTURE_2D, h.depth);
    gl->TexStorage2D(GL_TEXTURE_2D, 1, stencil ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT32F, HOST_WIDE,
                     HOST_HIGH);
    gl->BindTexture(GL_TEXTURE_2D, 0);
    gl->GenFramebuffers(1, &h.framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, h.framebuffer);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, h.color, 0);
    gl->FramebufferTexture2D(GL_FRAMEBUFFER, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                             GL_TEXTURE_2D, h.depth, 0);
    assert_int_equal(gl->CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    return h;
}

void host_free(draw_fixture *d, host *h)
{
    GLuint textures[2] = {h->color, h->depth};
    d->gl.gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
    d->gl.gl.DeleteFramebuffers(1, &h->framebuffer);
    d->gl.gl.DeleteTextures(2, textures);
}

static double window_depth(double z, double near, double far)
{
    return far * (z - near) / (z * (far - near));
}

void host_paint(draw_fixture *d, const host *h, const int rectangle[4], double z, double near, double far)
{
    static const GLfloat magenta[4] = {1, 0, 1, 1}, blue[4] = {0, 0, 1, 1};
    const GladGLContext *gl = &d->gl.gl;
    const GLfloat farthest = 1, here = (float)window_depth(z, near, far);
    gl->BindFramebuffer(GL_FRAMEBUFFER, h->framebuffer);
    gl->Disable(GL_SCISSOR_TEST);
    gl->ClearBufferfv(GL_COLOR, 0, magenta);
    gl->ClearBufferfv(GL_DEPTH, 0, &farthest);
    if (!rectangle) return;
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(rectangle[0], rectangle[1], rectangle[2], rectangle[3]);
    gl->ClearBufferfv(GL_COLOR, 0, blue);
    gl->ClearBufferfv(GL_DEPTH, 0, &here);
    gl->Disable(GL_SCISSOR_TEST);
}

host_pixels *host_read(draw_fixture *d, const host *h)
{
    host_pixels *p = malloc(sizeof *p);
    assert_non_null(p);
    d->gl.gl.BindFramebuffer(GL_FRAMEBUFFER, h->framebuffer);
    d->gl.gl.ReadPixels(0, 0, HOST_WIDE, HOST_HIGH, GL_RGBA, GL_UNSIGNED_BYTE, p->color);
    d->gl.gl.ReadPixels(0, 0, HOST_WIDE, HOST_HIGH, GL_DEPTH_COMPONENT, GL_FLOAT, p->depth);
    return p;
}

void host_draw_on(draw_fixture *d, const mns_field *field, const mns_view *view, const mns_target *target)
{
    mns_error error;
    const mns_options options = draw_by_lists(NULL);
    if (mns_renderer_draw_on(d->renderer, field, view, NULL, &options, target, d->frame, &error) != MNS_OK)
        fail_msg("%s", error.text);
    d->stats = *mns_frame_stats(d->frame);
}

/* ---- What the host should hold ---- */

/* Depth along the view of a pixel's hit; infinite on a miss. */
static double hit_depth(const mns_view *view, const mns_image *image, int x, int y)
{
    size_t at = (size_t)y * VIEW_WIDE + (size_t)x;
    double high = 2 * tan(view->fov * 3.14159265358979323846 / 360) / view->height;
    double across = (x + 0.5 - 0.5 * VIEW_WIDE) * high, up = (0.5 * VIEW_HIGH - y - 0.5) * high;
    return ((double)image->t[at] + (double)image->t_lo[at]) / sqrt(1 + across * across + up * up);
}

static int to_srgb8(double c)
{
    return (int)floor(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055) + 0.5);
}

static bool same_color(const uint8_t got[4], const float linear[4])
{
    for (int c = 0; c < 3; c++)
        if (abs(got[c] - to_srgb8(fmin((double)linear[c], 1))) > 1) return false;
    return got[3] == 255;
}

static bool is_host(const uint8_t got[4], bool in_rectangle)
{
    return got[0] == (in_rectangle ? 0 : 255) && got[1] == 0 && got[2] == 255 && got[3] == 255;
}

host_outcome host_expect_nearer_wins(const host_pixels *got, const mns_image *plain, const mns_view *view,
                                     const mns_target *target, const int rectangle[4], double z,
                                     double depth_slack)
{
    host_outcome seen = {0};
    for (int y = 0; y < HOST_HIGH; y++)
        for (int x = 0; x < HOST_WIDE; x++) {
            size_t at = (size_t)y * HOST_WIDE + (size_t)x;
            int vx = x - target->x, vy = VIEW_HIGH - 1 - (y - target->y);
            bool in_view = vx >= 0 && vx < VIEW_WIDE && vy >= 0 && vy < VIEW_HIGH;
            bool covered = rectangle && x >= rectangle[0] && x < rectangle[0] + rectangle[2] &&
                           y >= rectangle[1] && y < rectangle[1] + rectangle[3];
            double host_z = covered ? z : target->far,
                   ours = in_view ? hit_depth(view, plain, vx, vy) : INFINITY;
            if (fabs(ours - host_z) < 1e-5 * host_z) continue; /* rounding may say either */
            bool drawn = ours < host_z && ours > target->near;
            double depth = drawn     ? window_depth(ours, target->near, target->far)
                           : covered ? window_depth(z, target->near, target->far)
                                     : 1;
            const float *color = &plain->rgba[in_view ? 4 * ((size_t)vy * VIEW_WIDE + (size_t)vx) : 0];
            if (drawn ? !same_color(got->color[at], color) : !is_host(got->color[at], covered))
                fail_msg("pixel %d,%d: colour %d,%d,%d; hit at %g, host at %g", x, y, got->color[at][0],
                         got->color[at][1], got->color[at][2], ours, host_z);
            if (fabs((double)got->depth[at] - depth) > depth_slack)
                fail_msg("pixel %d,%d: depth %.9g, expected %.9g", x, y, (double)got->depth[at], depth);
            seen.ours += drawn;
            seen.behind += !drawn && isfinite(ours);
        }
    return seen;
}
