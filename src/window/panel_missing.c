/* The panel where Dear ImGui was not there when this was built: there is none. */
#include "window/panel.h"

bool panel_is_built_in(void)
{
    return false;
}

panel *panel_open(const panel_desc *desc)
{
    (void)desc;
    return NULL;
}

void panel_close(panel *p)
{
    (void)p;
}

void panel_show(panel *p, const panel_content *content)
{
    (void)p, (void)content;
}

bool panel_takes_mouse(const panel *p)
{
    (void)p;
    return false;
}

bool panel_takes_keys(const panel *p)
{
    (void)p;
    return false;
}

bool panel_measures(const panel *p)
{
    (void)p;
    return false;
}

void panel_help(panel *p, bool open)
{
    (void)p, (void)open;
}
