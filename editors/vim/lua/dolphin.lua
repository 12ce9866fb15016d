-- The language server in Neovim 0.7 and later. In init.lua:
--   vim.api.nvim_create_autocmd('FileType', { pattern = 'dolphin', callback = function() require('dolphin').start() end })
local dolphin = {}

local client

-- Attaches the current buffer to the server, which is started if it does not run. `command` is how, if dolphin is not
-- on the PATH.
function dolphin.start(command)
  local settings = {
    name = 'dolphin',
    cmd = command or { 'dolphin', 'lsp' },
    root_dir = vim.fn.getcwd(),
    on_exit = function() client = nil end,
  }
  if vim.lsp.start then
    return vim.lsp.start(settings)
  end
  client = client or vim.lsp.start_client(settings)
  vim.lsp.buf_attach_client(0, client)
  return client
end

return dolphin
