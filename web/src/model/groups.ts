/** Numbers by the group that each is in: those of group g from `offsets[g]` up to `offsets[g + 1]`. */
export interface Groups {
    readonly offsets: Uint32Array;
    readonly members: Uint32Array;
}

/** The places in `groupOf` by what stands there, ascending in each group. */
export function groupsOf(groupOf: Uint32Array, count: number): Groups {
    const offsets = new Uint32Array(count + 1);
    for (const group of groupOf) offsets[group + 1]! += 1;
    for (let g = 0; g < count; ++g) offsets[g + 1]! += offsets[g]!;
    const members = new Uint32Array(groupOf.length);
    const filled = offsets.slice();
    groupOf.forEach((group, place) => {
        members[filled[group]!++] = place;
    });
    return { offsets, members };
}

/** The numbers in one group; none in a group that is not there. */
export const membersOf = ({ offsets, members }: Groups, group: number): Uint32Array =>
    members.subarray(offsets[group] ?? 0, offsets[group + 1] ?? 0);
