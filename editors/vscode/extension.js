// Starts the language server, `dolphin lsp`, for programs and fleets.
const { workspace } = require('vscode')
const { LanguageClient } = require('vscode-languageclient/node')

let client

function activate() {
  const command = workspace.getConfiguration('dolphin').get('command') || 'dolphin'
  const server = { command, args: ['lsp'] }
  client = new LanguageClient('dolphin', 'Dolphin', server, { documentSelector: [{ language: 'dolphin' }] })
  return client.start()
}

function deactivate() {
  return client && client.stop()
}

module.exports = { activate, deactivate }
