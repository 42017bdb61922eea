// The per-pixel linked lists that gather leaves: heads in an image, nodes of (ball, next) in a buffer.

const uint NO_NODE = 0xffffffffu;

layout(binding = 0, r32ui) LISTS_ACCESS uniform uimage2D list_heads;
layout(std430, binding = 2) LISTS_ACCESS buffer Nodes {
    uvec2 list_nodes[];
};
