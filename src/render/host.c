#include "render/host.h"

void host_depth_take(list_passes *p, gl_device *device, const mns_plan *plan, const mns_target *target)
{
    const GladGLContext *gl = &device->gl;
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, target->framebuffer);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, p->host_depth);
    gl->CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, target->x, target->y, plan->frame.width,
                          plan->frame.height);
    gl->BindTexture(GL_TEXTURE_2D, 0);
}

void host_draw(list_passes *p, gl_device *device, const mns_plan *plan, const mns_target *target,
               GLuint program, GLuint shaded, GLuint t)
{
    const GladGLContext *gl = &device->gl;
    gl->BindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    gl->Viewport(target->x, target->y, plan->frame.width, plan->frame.height);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(target->x, target->y, plan->frame.width, plan->frame.height);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LESS);
    gl->DepthMask(GL_TRUE);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, 0, p->view.id);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, shaded);
    gl->ActiveTexture(GL_TEXTURE1);
    gl->BindTexture(GL_TEXTURE_2D, t);
    gl->UseProgram(program);
    gl->BindVertexArray(p->vertex_array);
    for (GLuint i = 0; i < 3; i++) gl->DisableVertexAttribArray(i);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->BindVertexArray(0);
}
