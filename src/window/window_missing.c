/* The window where GLFW was not there when this was built: there is none. */
#include "base/status.h"
#include "window/window.h"

mns_status window_run(const window_desc *desc, mns_error *error)
{
    (void)desc;
    return status_fail(error, MNS_ERROR_UNSUPPORTED,
                       "no window: this was built without GLFW; \"meniscus render\" draws to a file");
}

char *window_actions_text(void)
{
    return NULL;
}
