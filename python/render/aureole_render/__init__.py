"""libaureole-render and what it links, for `import aureole` to find: `aureole.render` and its like are there."""
