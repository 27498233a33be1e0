"""The frame in a project file: grid, members, sections, materials, supports, hinges."""
