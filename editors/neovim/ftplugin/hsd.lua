-- Blanks are significant, also at the ends of lines: codes are five columns wide.
if vim.b.did_ftplugin == 1 then
  return
end
vim.b.did_ftplugin = 1

local first = vim.fn.getline(vim.fn.nextnonblank(1))
local xml = first:match('^%s*<') ~= nil

vim.bo.expandtab = true
vim.bo.tabstop = xml and 2 or 5
vim.bo.shiftwidth = xml and 2 or 5
vim.bo.softtabstop = xml and 2 or 5
vim.bo.textwidth = 0
vim.bo.autoindent = xml
vim.bo.commentstring = xml and '<!-- %s -->' or '# %s'
vim.bo.comments = xml and 's:<!--,m:    ,e:-->' or ':#'
vim.opt_local.formatoptions:remove({ 't', 'c', 'a' })

-- Disables everything that trims trailing blanks: Neovim's editorconfig, mini.trailspace, vim-better-whitespace.
vim.b.minitrailspace_disable = true
vim.b.strip_whitespace_on_save = 0
vim.b.better_whitespace_enabled = 0
local buffer = vim.api.nvim_get_current_buf()
local function keep_blanks()
  for _, group in ipairs({ 'editorconfig', 'nvim.editorconfig' }) do
    pcall(vim.api.nvim_clear_autocmds, { event = 'BufWritePre', group = group, buffer = buffer })
  end
end
-- The .editorconfig of a project may be read before or after this file.
keep_blanks()
vim.schedule(keep_blanks)

vim.b.undo_ftplugin = 'setlocal expandtab< tabstop< shiftwidth< softtabstop< textwidth< autoindent< commentstring< '
  .. 'comments< formatoptions<'
