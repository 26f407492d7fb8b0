// SPDX-License-Identifier: Apache-2.0
//
// The element, for a document that a test writes.
import '../../../web/src/element/index.js';
