// Merge sort of a linked list in place by the includer's list_before, runs of 1, 2, 4, ... nodes: n log n and no memory.
uint list_sort(uint head)
{
    for (uint run = 1u;; run *= 2u) {
        uint rest = head, last = NO_NODE;
        head = NO_NODE;
        int merges = 0;
        while (rest != NO_NODE) {
            merges++;
            uint left = rest, right = rest;
            uint left_size = 0u, right_size = run;
            for (; left_size < run && right != NO_NODE; left_size++) right = list_nodes[right].y;
            while (left_size > 0u || (right_size > 0u && right != NO_NODE)) {
                uint taken;
                bool from_left = left_size > 0u && (right_size == 0u || right == NO_NODE || !list_before(right, left));
                if (from_left) {
                    taken = left;
                    left = list_nodes[left].y;
                    left_size--;
                } else {
                    taken = right;
                    right = list_nodes[right].y;
                    right_size--;
                }
                if (last == NO_NODE)
                    head = taken;
                else
                    list_nodes[last].y = taken;
                last = taken;
            }
            rest = right;
        }
        if (last != NO_NODE) list_nodes[last].y = NO_NODE;
        if (merges <= 1) return head;
    }
}
